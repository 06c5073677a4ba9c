"""Answers handed out from code: the files of the command line, a table, a picture; mistakes name the argument."""

from __future__ import annotations

import builtins
import json
import sys
from functools import cache
from hashlib import sha256
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from command_line import run

from synergrip import __version__
from synergrip.errors import InputError, OutputError
from synergrip.planning.digest import unchanged
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan
from synergrip.problems.problem import Problem, load_problem
from synergrip.reports.data.plan_files import plan_csv


@cache
def asked(name: str) -> tuple[Problem, Plan | Infeasible]:
    problem = load_problem(name)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan | Infeasible)
    return problem, answer


def feasible(name: str) -> Plan:
    answer = asked(name)[1]
    assert isinstance(answer, Plan)
    return answer


def without_times(value: Any) -> Any:
    """Return a document without what differs from run to run."""
    if isinstance(value, dict):
        return {key: without_times(each) for key, each in value.items() if key not in ("seconds", "date")}
    return [without_times(each) for each in value] if isinstance(value, list) else value


@pytest.mark.parametrize("name", ["tripod", "barrett-ball-hold", "barrett-ball-lift"])
def test_code_writes_the_files_of_the_command_line(name: str, tmp_path: Path) -> None:
    run("plan", name, "-o", str(tmp_path / "line"))
    problem, answer = asked(name)
    files = answer.save(tmp_path / "code", problem=problem)
    assert {path.name for path in files} == {path.name for path in (tmp_path / "line").iterdir()}
    for path in files:
        other = tmp_path / "line" / path.name
        if path.suffix == ".json":
            found, expected = (json.loads(each.read_text(encoding="utf-8")) for each in (path, other))
            assert without_times(found) == without_times(expected)
        elif path.suffix == ".csv":
            assert path.read_bytes() == other.read_bytes()
        else:
            with np.load(path) as one, np.load(other) as two:
                assert set(one) == set(two)
                assert all(np.array_equal(one[key], two[key]) for key in one)


def test_an_answer_made_in_code_is_written_without_a_problem(tmp_path: Path) -> None:
    (only,) = feasible("tripod").save(str(tmp_path / "new" / "folder"), formats="json")
    document = json.loads(only.read_text(encoding="utf-8"))
    assert document["title"] == asked("tripod")[0].grasp.title
    assert document["provenance"]["problem"] is None


def test_provenance_says_which_question_was_answered(tmp_path: Path) -> None:
    problem = load_problem("pinch-soft", ["limits.margin=0.4 N"])
    answer = plan(problem.grasp, problem.task)
    answer.save(tmp_path, formats=["json"], problem=problem)
    document = json.loads((tmp_path / "plan.json").read_text(encoding="utf-8"))
    text = problem.path.read_bytes()
    assert document["provenance"] | {"date": ""} == {
        "version": __version__, "overrides": ["limits.margin=0.4 N"], "date": "",
        "problem": {"name": "pinch-soft", "text": text.decode(), "sha256": sha256(text).hexdigest()},
        "solver": document["programs"][-1]["solver"],
    }  # fmt: skip
    assert document["provenance"]["date"].startswith("20")
    document["provenance"] = {}
    assert unchanged(document)
    document["lambda"][0][0] *= 1 + 1e-15
    assert not unchanged(document)


def test_the_table_has_the_columns_of_the_csv_file(monkeypatch: pytest.MonkeyPatch) -> None:
    """With a stand-in for pandas, so that it is tested everywhere; it takes a table and the names of its columns."""
    standin = SimpleNamespace(DataFrame=lambda table, columns: (table, columns))
    monkeypatch.setitem(sys.modules, "pandas", standin)
    table, columns = feasible("tripod").frame()
    header, *lines = plan_csv(feasible("tripod")).splitlines()
    assert columns == header.split(",")
    assert np.array_equal(table, np.loadtxt(lines, delimiter=","))


def test_without_pandas_the_table_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def refuse(name: str, *rest: Any, **named: Any) -> Any:
        if name == "pandas":
            raise ImportError(name)
        return real(name, *rest, **named)

    monkeypatch.setattr(builtins, "__import__", refuse)
    with pytest.raises(InputError, match="pip install pandas"):
        feasible("tripod").frame()


def test_a_picture_is_drawn(tmp_path: Path) -> None:
    drawn = feasible("tripod").draw(tmp_path / "plan.svg")
    assert drawn == tmp_path / "plan.svg"
    assert "slip margin" in drawn.read_text(encoding="utf-8")
    with pytest.raises(InputError) as caught:
        feasible("tripod").draw(tmp_path / "plan.doc")
    assert caught.value.issues[0].key == "path"


@pytest.mark.parametrize(
    ("arguments", "key"),
    [
        ({"folder": 3}, "folder"), ({"folder": ""}, "folder"), ({"folder": "a\0b"}, "folder"),
        ({"formats": "jsn"}, "formats"), ({"formats": ()}, "formats"), ({"formats": 7}, "formats"),
        ({"formats": ["json", 3]}, "formats"),
    ],
)  # fmt: skip
def test_mistakes_name_the_argument(arguments: dict[str, Any], key: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        feasible("tripod").save(**({"folder": tmp_path / "out"} | arguments))
    assert caught.value.issues[0].key == key
    assert not (tmp_path / "out").exists()


def test_a_place_that_is_no_folder_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine", encoding="utf-8")
    with pytest.raises(InputError, match="cannot write"):
        feasible("tripod").save(tmp_path / "file" / "below")
    (tmp_path / "out" / "plan.json").mkdir(parents=True)
    with pytest.raises((InputError, OutputError), match="cannot write"):
        feasible("tripod").save(tmp_path / "out")
