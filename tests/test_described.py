"""What pages describe is what there is: keys of problem files and answers, public names, Table II."""

from __future__ import annotations

import re
import tomllib

import pytest
from pages import ROOT, blocks

import synergrip
from synergrip.documents.documents import Document, parse
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.problems.problem_file import ProblemFile, problem_schema
from synergrip.reports.data.json_plan import outcome_document
from synergrip.statics.analysis import analyse


def page(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def keys(schema: dict, root: dict) -> set[str]:
    """All keys that a problem file may hold."""
    found = set()
    for node in [schema, *root.get("$defs", {}).values()]:
        found |= set(node.get("properties", {}))
    return found


def test_every_key_of_a_problem_file_is_described() -> None:
    text, schema = page("docs/problem-file.md"), problem_schema()
    missing = sorted(key for key in keys(schema, schema) if not re.search(rf"`[^`]*\b{key}\b[^`]*`", text))
    assert not missing


def test_the_examples_of_the_problem_file_are_in_order() -> None:
    examples = [block.text for block in blocks(ROOT / "docs" / "problem-file.md") if block.kind == "toml"]
    assert examples
    for code in examples:
        parse(Document(ROOT / "example.toml", tomllib.loads(code), code), ProblemFile)


@pytest.mark.parametrize("name", ["tripod", "pinch-hard", "barrett-ball-lift"])
def test_every_key_of_an_answer_is_described(name: str) -> None:
    problem = load_problem(name)
    document = outcome_document("", problem.grasp, plan(problem.grasp, problem.task))
    assert not [key for key in document if f"`{key}`" not in page("docs/answers.md")]


def test_the_table_of_names_has_all_that_is_public() -> None:
    named = re.findall(r"`(\w+)`", page("docs/in-code.md").partition("## Names")[2])
    assert sorted(named) == sorted(set(synergrip.__all__) - {"__version__"})


def test_the_singular_values_of_table_two_are_those_of_analyse() -> None:
    decisions = {"J S": "redundancy", "part of J S that no rigid motion follows": "rigid"}
    shown = blocks(ROOT / "problems" / "README.md")[-1].text.splitlines()
    assert len(shown) == 8
    for line in shown:
        name, what, values = re.fullmatch(r"(\S+)\s+(J S|part.*?follows)\s+([\d. ]+)", line).groups()
        found = analyse(load_problem(f"table2-{name}").grasp).spaces.decisions[decisions[what]].singular_values
        assert values.split() == [f"{value:.3f}" if value > 1e-11 else "0" for value in found]
