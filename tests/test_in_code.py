"""The code of docs/in-code.md runs from top to bottom and prints what the page shows; it names what is public."""

from __future__ import annotations

import contextlib
import io
import logging
import re
import subprocess
import sys
from pathlib import Path

import pytest

import synergrip

TEXT = (Path(__file__).parent.parent / "docs" / "in-code.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", TEXT, re.DOTALL | re.MULTILINE)
NUMBER = r"\d+(?:\.\d+)?(?:e[-+]\d+)?"


def last_digit(number: str) -> float:
    """What one more in the last digit is worth; nothing in a number without a fraction."""
    digits = len(number.partition(".")[2])
    return 10.0**-digits if digits else 0.0


def judge(printed: str, shown: str) -> None:
    assert re.sub(NUMBER, "#", printed).split() == re.sub(NUMBER, "#", shown).split()
    for number, other in zip(re.findall(NUMBER, printed), re.findall(NUMBER, shown), strict=True):
        assert abs(float(number) - float(other)) <= 1.01 * last_digit(other), (number, other)


def test_the_page_runs_from_top_to_bottom(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    logger = logging.getLogger("synergrip")
    level = logger.level
    space: dict[str, object] = {"__name__": "page"}
    monkeypatch.setitem(sys.modules, "page", type(sys)("page"))  # where dataclasses look for their module
    after = [*BLOCKS[1:], ("", "")]
    try:
        for (kind, code), (following, shown) in zip(BLOCKS, after, strict=True):
            if kind == "python":
                with contextlib.redirect_stdout(io.StringIO()) as printed:
                    exec(compile(code, "in-code.md", "exec"), space)
                judge(printed.getvalue(), shown if following == "text" else "")
    finally:
        logger.setLevel(level)
    made = {"ball.svg", "margins.png", "out/ball/plan.json", "out/ball/plan.npz", "out/ball/plan.csv"}
    assert made <= {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()}


def test_the_table_names_what_is_public_in_the_order_of_the_pipeline_by_group() -> None:
    named = re.findall(r"`(\w+)`", TEXT.partition("## Names")[2])
    assert sorted(named) == sorted(set(synergrip.__all__) - {"__version__"})


def test_the_code_of_all_pages_is_written_for_the_type_checker(tmp_path: Path) -> None:
    script = Path(__file__).parent / "code_of_pages.py"
    subprocess.run([sys.executable, str(script), str(tmp_path)], check=True, capture_output=True)
    assert {"readme_page.py", "in_code_page.py"} <= {path.name for path in tmp_path.iterdir()}
