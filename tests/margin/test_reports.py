"""Margins on the command line, as JSON, and on their page."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from command_line import run

import synergrip as sg
from synergrip.cli.margins import ASKED
from synergrip.margin.direct import NUMBERS
from synergrip.margin.margins import BESIDE
from synergrip.reports.data.json_margins import margins_document

PAGE = (Path(__file__).parents[2] / "docs" / "margins.md").read_text(encoding="utf-8")
NAMES = list(NUMBERS)


def test_the_code_of_the_page_runs() -> None:
    for code in re.findall(r"^```python\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE):
        exec(compile(code, "margins.md", "exec"), {})


def test_the_document_has_all_numbers_or_why_not() -> None:
    problem = sg.load_problem("tripod")
    found = sg.margins(problem.grasp, problem.task)
    assert isinstance(found, sg.Margins)
    document = margins_document(problem.title, found)
    json.dumps(document, allow_nan=False)
    assert list(document["direct"]) == NAMES
    for each in document["direct"].values():
        assert set(each) >= ({"value", "why"} if each["value"] is None else {"value", "lower", "upper", "proven"})
    assert document["margin"]["worst_N"] == pytest.approx(document["measures"]["slip margin"]["worst"]["value"])
    assert len(document["measures"]["slip margin"]["per_contact"]) == len(document["time_s"])


def test_one_number_of_a_hand_is_printed_beside_its_linear_model() -> None:
    done = run("margins", "gripper-peg", "--only", "heaviest_kg")
    assert done.exit_code == 0
    assert "linear model" in done.stdout
    (line,) = (line for line in done.stdout.splitlines() if line.startswith("how heavy"))
    setting = re.search(r"--set '(.*)'", line)
    assert setting is not None
    again = sg.load_problem("gripper-peg", [setting[1]])
    assert sg.plan(again.grasp, again.task).verdict == "feasible"


def test_the_help_has_every_name_that_may_be_asked_for() -> None:
    assert set(ASKED.split(", ")) == {*NAMES, *BESIDE}
    words = " ".join(re.sub(r"[^\w ]", " ", run("margins", "--help").stdout).split())
    assert all(name in words.replace(" ", "") for name in NAMES)


def test_where_there_is_no_plan_the_no_is_told() -> None:
    done = run("margins", "tripod", "--set", 'limits.normal_force="1 N"', "--format", "json")
    assert done.exit_code == 1
    assert json.loads(done.stdout)["verdict"] == "infeasible"


def test_a_number_that_is_none_is_a_bad_input() -> None:
    done = run("margins", "tripod", "--only", "heaviest")
    assert done.exit_code == 2
    assert "heaviest_kg" in done.stderr
