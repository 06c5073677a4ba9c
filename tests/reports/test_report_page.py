"""What docs/report.md shows is what happens."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from command_line import run

PAGE = Path(__file__).parents[2] / "docs" / "report.md"


def test_the_commands_of_the_page_say_what_it_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```(bash|text)\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.S)
    assert [kind for kind, _ in blocks] == ["bash", "bash", "text"]
    first, second = (shlex.split(text) for kind, text in blocks if kind == "bash")
    assert first[0] == second[0] == "synergrip"
    assert run(*first[1:]).exit_code == 0
    assert run(*second[1:]).stdout == blocks[2][1]
