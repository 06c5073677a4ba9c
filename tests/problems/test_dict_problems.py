"""Problems as dicts, of the structure of a problem file."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.files import bundled
from synergrip.problems.problem import load_problem


def values(name: str) -> dict[str, Any]:
    return tomllib.loads((bundled("problems") / f"{name}.toml").read_text(encoding="utf-8"))


def test_a_dict_is_the_problem_of_its_file() -> None:
    problem, other = load_problem(values("barrett-ball-hold")), load_problem("barrett-ball-hold")
    np.testing.assert_array_equal(problem.timed.wrench, other.timed.wrench)
    np.testing.assert_array_equal(problem.grasp.G, other.grasp.G)
    assert problem.name == problem.title == other.title


def test_files_of_a_dict_are_looked_for_in_the_current_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(bundled("problems"))
    assert load_problem(values("tripod")).timed.times.tolist() == load_problem("tripod").timed.times.tolist()
    monkeypatch.chdir("/")
    with pytest.raises(InputError) as caught:
        load_problem(values("tripod"))
    assert {issue.key for issue in caught.value.issues} >= {"grasp.file"}


def test_tuples_arrays_and_paths_stand_for_what_a_file_has() -> None:
    data = values("pinch-soft")
    data["grasp"]["file"] = bundled("problems") / "pinch-soft.json"
    data["task"] = {"wrench": np.array([0, 0, -1.0, 0, 0, 0]), "knots": np.int64(3), "duration": "2 s"}
    problem = load_problem(data)
    assert problem.timed.wrench == pytest.approx(np.tile([0, 0, -1.0, 0, 0, 0], (3, 1)))
    assert isinstance(data["task"]["wrench"], np.ndarray)


@pytest.mark.parametrize(
    ("change", "key", "fragment"),
    [
        ({"task": {"knots": 0}}, "task.knots", "must be at least 1"),
        ({"task": {"knotz": 3}}, "task.knotz", "did you mean 'knots'"),
        ({"task": {"wrench": [0, 0, float("nan"), 0, 0, 0]}}, "task.wrench[2]", "not a finite number"),
        ({"task": {"wrench": {1, 2}}}, "task.wrench", "expected a text, a number"),
        ({"task": {3: 4}}, "task", "keys that are texts"),
        ({"limits": {"margin": 3}}, "limits.margin", "N"),
        ({"task": {"push": [{"force": "1 N", "direction": "x", "end": "9 s"}]}}, "task.push[0].end", "ends at 9 s"),
    ],
)
def test_errors_of_a_dict_name_the_key_and_no_line(change: dict[str, Any], key: str, fragment: str) -> None:
    with pytest.raises(InputError) as caught:
        load_problem({**values("barrett-ball-hold"), **change})
    (issue,) = caught.value.issues
    assert (issue.key, issue.file, issue.line) == (key, "", 0)
    assert fragment in issue.message


def test_one_override_may_be_a_text() -> None:
    assert load_problem("barrett-ball-hold", "limits.margin=0.25 N").timed.margin == 0.25
    assert load_problem(values("barrett-ball-hold"), "limits.margin=0.25 N").timed.margin == 0.25
    with pytest.raises(InputError, match="expected KEY=VALUE"):
        load_problem("barrett-ball-hold", "margin")


@pytest.mark.parametrize("wrong", [3, None, ["barrett-ball-hold"]])
def test_something_else_is_no_problem(wrong: Any) -> None:
    with pytest.raises(InputError, match="expected a name, a path or a dict"):
        load_problem(wrong)


def test_a_path_is_a_problem_too(tmp_path: Path) -> None:
    assert load_problem(bundled("problems") / "pinch-hard.toml").name == "pinch-hard"
