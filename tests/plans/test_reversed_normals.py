"""A no that normals the other way would turn into a yes says so, and what it advises does it."""

from __future__ import annotations

import json
import re
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from synergrip.files import bundled
from synergrip.plans.outcome import Infeasible, Outcome, Plan
from synergrip.plans.planning import plan
from synergrip.plans.problem import load_problem
from synergrip.plans.reversed_normals import reversed_normals
from synergrip.reports.json_plan import outcome_document
from synergrip.reports.text_plan import verdict_lines

ROWS = {"hard": 3, "soft": 4, "frictionless": 1}
Grasps = dict[str, Any]


def grasp_file(name: str) -> Grasps:
    data: Grasps = json.loads((bundled("problems") / f"{name}.json").read_text(encoding="utf-8"))
    data.pop("expect", None)
    return data


def turned(data: Grasps, chosen: tuple[int, ...]) -> Grasps:
    """The file with the normals of the chosen contacts outward, everything else as their author means it."""
    made: Grasps = json.loads(json.dumps(data))
    starts = np.cumsum([0, *(ROWS[c["kind"]] for c in made["contacts"])])
    for k in chosen:
        negate(made, f"contacts[{k}].normal")
        for row in made["G"]:
            row[starts[k]] = -row[starts[k]]
        made["J"][starts[k]] = [-value for value in made["J"][starts[k]]]
        if "lambda_0" in made:
            made["lambda_0"][starts[k]] = -made["lambda_0"][starts[k]]
    return made


def negate(data: Grasps, key: str) -> None:
    index = int(re.findall(r"\d+", key)[0])
    if "normal" in data["contacts"][index]:
        data["contacts"][index]["normal"] = [-value for value in data["contacts"][index]["normal"]]


def answer(folder: Path, name: str, data: Grasps, *overrides: str) -> tuple[Outcome, list[str], tuple[str, ...]]:
    """The bundled problem of that name with another grasp file."""
    for path in bundled("problems").glob(f"{name}*"):
        (folder / path.name).write_bytes(path.read_bytes())
    (folder / f"{name}.json").write_text(json.dumps(data), encoding="utf-8")
    problem = load_problem(folder / f"{name}.toml", overrides)
    outcome = plan(problem.grasp, problem.task)
    return outcome, verdict_lines(problem, outcome), problem.notes


def follow(data: Grasps, hint: str) -> Grasps:
    """Change the sign of everything that the hint names, and of nothing else."""
    made: Grasps = json.loads(json.dumps(data))
    places = hint[hint.index("the sign of ") :]
    for key in re.findall(r"contacts\[\d+\]\.normal", places):
        negate(made, key)
    for column in map(int, re.findall(r"column (\d+) of G", places)):
        for row in made["G"]:
            row[column] = -row[column]
    for row in map(int, re.findall(r"(?<!and column )row (\d+) of J", places)):
        made["J"][row] = [-value for value in made["J"][row]]
    for row in map(int, re.findall(r"row and column (\d+) of C_s", places)):
        C_s = np.array(made["C_s"], dtype=float)
        C_s[row] *= -1
        C_s[:, row] *= -1
        made["C_s"] = C_s.tolist()
    for row in map(int, re.findall(r"lambda_0\[(\d+)\]", places)):
        made["lambda_0"][row] = -made["lambda_0"][row]
    return made


CHOICES = [(name, chosen) for name, n in (("pinch-soft", 2), ("tripod", 3)) for size in range(1, n)
           for chosen in combinations(range(n), size)]  # fmt: skip


@pytest.mark.parametrize(("name", "chosen"), CHOICES)
def test_the_contacts_that_are_the_wrong_way_round_are_named_and_turning_them_helps(
    name: str, chosen: tuple[int, ...], tmp_path: Path
) -> None:
    data = grasp_file(name)
    outcome, text, _ = answer(tmp_path, name, turned(data, chosen))
    assert isinstance(outcome, Infeasible)
    (hint,) = outcome.hints
    for k, contact in enumerate(data["contacts"]):
        assert (f"'{contact['name']}'" in hint) == (k in chosen)
    mended = follow(turned(data, chosen), hint)
    assert mended == turned(turned(data, chosen), chosen)
    repaired, _, _ = answer(tmp_path, name, mended)
    assert isinstance(repaired, Plan)
    assert any(line.startswith("Hint ") for line in text)
    assert outcome.analysis is not None
    assert outcome_document("", outcome.analysis.grasp, outcome)["hints"] == [hint]


def test_coupled_compliances_and_initial_forces_turn_with_the_normal(tmp_path: Path) -> None:
    data = grasp_file("pinch-soft")
    C_s = 1e-3 * np.eye(8)
    C_s[4, 5] = C_s[5, 4] = 2e-4
    squeeze = [3.0, 0, 0, 0, 3.0, 0, 0, 0]
    data |= {"C_s": C_s.tolist(), "lambda_0": squeeze}
    data.pop("w_0", None)
    wrong = turned(data, (1,))
    wrong["C_s"] = (np.diag([1, 1, 1, 1, -1, 1, 1, 1]) @ C_s @ np.diag([1, 1, 1, 1, -1, 1, 1, 1])).tolist()
    outcome, _, _ = answer(tmp_path, "pinch-soft", wrong)
    assert isinstance(outcome, Infeasible)
    (hint,) = outcome.hints
    assert "row and column 4 of C_s" in hint
    assert "lambda_0[4]" in hint
    mended = follow(wrong, hint)
    assert np.array_equal(mended["C_s"], C_s)
    assert mended["lambda_0"] == squeeze
    assert isinstance(answer(tmp_path, "pinch-soft", mended)[0], Plan)


@pytest.mark.parametrize("name", ["pinch-soft", "tripod"])
def test_a_no_that_reversing_does_not_help_has_no_hint(name: str, tmp_path: Path) -> None:
    for chosen in ((), (0,)):
        outcome, text, _ = answer(tmp_path, name, turned(grasp_file(name), chosen), "limits.margin=1000 N")
        assert isinstance(outcome, Infeasible)
        assert outcome.hints == ()
        assert not any(line.startswith("Hint") for line in text)


def test_a_load_that_only_pulling_fingers_could_hold_is_no_hint_where_surfaces_give_the_normals() -> None:
    """The ball's normals are those of its surface: nobody stated them, and nobody can have them the wrong way."""
    problem = load_problem("barrett-ball-hold", ["contacts.friction=0.3"])
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Infeasible)
    assert outcome.hints == ()


@pytest.mark.parametrize("name", ["pinch-soft", "tripod"])
def test_normals_that_all_point_outward_are_noted(name: str, tmp_path: Path) -> None:
    """Friction and squeeze are the same then, and the answer is a plan that opens the hand: only a note can tell."""
    data = grasp_file(name)
    right, _, silent = answer(tmp_path, name, data)
    wrong, text, (note,) = answer(tmp_path, name, turned(data, tuple(range(len(data["contacts"])))))
    assert silent == ()
    assert "point away from the middle" in note
    assert any("point away from the middle" in line for line in text)
    assert isinstance(right, Plan)
    assert isinstance(wrong, Plan)


def test_reversed_twice_is_the_grasp_itself_and_once_is_pulling() -> None:
    problem = load_problem("pinch-soft")
    grasp = problem.grasp
    once = reversed_normals(grasp, (1,))
    twice = reversed_normals(once, (1,))
    for name in ("G", "J", "C_s"):
        assert np.array_equal(getattr(twice, name), getattr(grasp, name))
    pushed = np.eye(1, grasp.n_l, 4)[0]
    assert np.array_equal(once.G @ pushed, -grasp.G @ pushed)
    assert np.array_equal(once.J.T @ pushed, -grasp.J.T @ pushed)


LINKS = "contact=[{{link='left_tip', name='left', normal={left}}}, {{link='right_tip', name='right', normal={right}}}]"
SOFT = "contacts={model='soft', friction=0.6, spin_friction='8 mm', stiffness='8 N/mm', spin_stiffness='2 N m/rad'}"


def test_a_normal_stated_on_a_link_the_wrong_way_round_is_named_by_its_key() -> None:
    problem = load_problem("gripper-box")
    assert problem.held is not None
    normals = {touch.name.split("/")[0]: touch.pad.normal.tolist() for touch in problem.held.touches}
    common = ("object={mass='100 g', position=['35 mm', '40 mm', '120 mm']}", SOFT, "limits={normal_force='40 N'}",
              "goal={minimise='effort'}", "task={gravity=[0, 0, -9.81]}")  # fmt: skip

    def at(left: list[float], right: list[float]) -> Outcome:
        made = load_problem("gripper-box", [*common, LINKS.format(left=left, right=right)])
        return plan(made.grasp, made.task)

    assert isinstance(at(**normals), Plan)
    backwards = {"left": normals["left"], "right": [-value for value in normals["right"]]}
    outcome = at(**backwards)
    assert isinstance(outcome, Infeasible)
    (hint,) = outcome.hints
    assert hint.endswith("by changing the sign of contact[1].normal")
