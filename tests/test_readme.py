"""What the README shows is what the program prints. (The install commands are run by .ci/run.)"""

from __future__ import annotations

import contextlib
import io
import re
import shlex
import subprocess
import sys
import tomllib
from itertools import pairwise
from pathlib import Path

import pytest

from synergrip.problems.problem_file import problem_schema

ROOT = Path(__file__).parent.parent
BLOCK = re.compile(r"```(\w+)\n(.*?)\n```", re.DOTALL)
README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = BLOCK.findall(README)
NUMBER = r"\d+(?:\.\d+)?(?:e[-+]\d+)?"
VOLATILE = re.compile(rf"{NUMBER} ms(?:, \d+ attempts)?|\d+(?:\.\d+)?e[-+]\d+|\d+ iterations|Clarabel [\d.]+")
"""Residuals, iterations, attempts, times and versions: the machine's, not the answer's."""


EXPLAIN, MARGINS, QUALITY, ALLOWANCES = (
    BLOCK.findall((ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8"))
    for name in ("explain", "margins", "quality", "allowances")
)


def following(language: str, blocks: list[tuple[str, str]] = BLOCKS) -> list[tuple[str, str]]:
    """Blocks of a language, each with the text block right after it."""
    pairs = pairwise(blocks)
    return [(code, shown) for (kind, code), (after, shown) in pairs if kind == language and after == "text"]


def words(text: str) -> list[str]:
    """The text without its numbers and the spaces that align it."""
    return re.sub(NUMBER, "#", text).split()


def numbers(text: str) -> list[str]:
    return re.findall(NUMBER, text)


def last_digit(number: str) -> float:
    """What one more in the last digit is worth; nothing in a number without a fraction, which counts or names."""
    digits = len(number.partition(".")[2])
    return 10.0**-digits if digits else 0.0


@pytest.mark.parametrize(
    ("code", "shown"),
    [pair for page in (BLOCKS, EXPLAIN, MARGINS, QUALITY, ALLOWANCES) for pair in following("bash", page)],
    ids=["plan", "no", "analyse", "trajectory", "table", "explain", "margins", "quality", "allowances"],
)
def test_commands_print_what_is_shown(code: str, shown: str, tmp_path: Path) -> None:
    arguments = shlex.split(code.split("synergrip ", 1)[-1])
    run = subprocess.run(
        [sys.executable, "-m", "synergrip", *arguments], capture_output=True, text=True, cwd=tmp_path, check=False
    )
    printed, expected = (VOLATILE.sub("#", text.rstrip("\n")) for text in (run.stdout, shown))
    assert words(printed) == words(expected), run.stderr
    for number, other in zip(numbers(printed), numbers(expected), strict=True):
        assert abs(float(number) - float(other)) <= 1.01 * last_digit(other), (number, other)


@pytest.mark.parametrize(("code", "shown"), following("python"))
def test_python_prints_what_is_shown(code: str, shown: str) -> None:
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(code, "README.md", "exec"), {})
    assert words(printed.getvalue()) == words(shown)
    for number, other in zip(numbers(printed.getvalue()), numbers(shown), strict=True):
        assert abs(float(number) - float(other)) <= 1.01 * last_digit(other), (number, other)


def test_every_block_is_run() -> None:
    """Five commands with their output, one program, one that draws; the second command is the test run itself."""
    assert len(following("bash")) == 5
    assert len(following("python")) == 1
    assert [kind for kind, _ in BLOCKS].count("bash") == 7


def test_links_lead_somewhere() -> None:
    for page in (
        ROOT / "README.md",
        *ROOT.glob("docs/*.md"),
        ROOT / "problems" / "README.md",
        ROOT / "CONTRIBUTING.md",
    ):
        for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
            assert (page.parent / target).exists(), f"{page.name}: {target}"


def keys(schema: dict, root: dict) -> set[str]:
    """All keys that a problem file may hold."""
    found = set()
    for node in [schema, *root.get("$defs", {}).values()]:
        found |= set(node.get("properties", {}))
    return found


def test_every_key_of_a_problem_file_is_described() -> None:
    text = (ROOT / "docs" / "problem-file.md").read_text(encoding="utf-8")
    schema = problem_schema()
    missing = sorted(key for key in keys(schema, schema) if not re.search(rf"`[^`]*\b{key}\b[^`]*`", text))
    assert not missing


def test_the_examples_of_the_problem_file_are_in_order() -> None:
    from synergrip.documents.documents import Document, parse
    from synergrip.problems.problem_file import ProblemFile

    text = (ROOT / "docs" / "problem-file.md").read_text(encoding="utf-8")
    examples = [code for kind, code in BLOCK.findall(text) if kind == "toml"]
    assert examples
    for code in examples:
        parse(Document(ROOT / "example.toml", tomllib.loads(code), code), ProblemFile)


@pytest.mark.parametrize("name", ["tripod", "pinch-hard", "barrett-ball-lift"])
def test_every_key_of_an_answer_is_described(name: str) -> None:
    from synergrip.planning.planning import plan
    from synergrip.problems.problem import load_problem
    from synergrip.reports.data.json_plan import outcome_document

    text = (ROOT / "docs" / "answers.md").read_text(encoding="utf-8")
    problem = load_problem(name)
    document = outcome_document("", problem.grasp, plan(problem.grasp, problem.task))
    assert not [key for key in document if f"`{key}`" not in text]


def test_the_singular_values_of_table_two_are_those_of_analyse() -> None:
    from synergrip.problems.problem import load_problem
    from synergrip.statics.analysis import analyse

    keys = {"J S": "redundancy", "part of J S that no rigid motion follows": "rigid"}
    shown = BLOCK.findall((ROOT / "problems" / "README.md").read_text(encoding="utf-8"))[-1][1].splitlines()
    assert len(shown) == 8
    for line in shown:
        name, what, values = re.fullmatch(r"(\S+)\s+(J S|part.*?follows)\s+([\d. ]+)", line).groups()
        found = analyse(load_problem(f"table2-{name}").grasp).spaces.decisions[keys[what]].singular_values
        assert values.split() == [f"{value:.3f}" if value > 1e-11 else "0" for value in found]
