"""A no that normals the other way would turn into a yes says so, and what it advises does it."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from driven_grasp import driven
from made_kinds import made_kind
from random_tasks import hand_like_grasp

from synergrip.files import bundled
from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.contacts.kinds import KINDS, PARAMETERS
from synergrip.grasps.grasp import grasp_matrix
from synergrip.linalg import frozen
from synergrip.planning.outcome import Infeasible, Outcome, Plan
from synergrip.planning.planning import plan
from synergrip.planning.reversed_normals import reversed_normals
from synergrip.problems.problem import load_problem
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.text.text_plan import verdict_lines
from synergrip.statics import respond

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


@pytest.mark.parametrize("seed", range(6))
def test_reversed_normals_are_the_same_grasp_with_other_signs(seed: int) -> None:
    """Coupled compliances too: the object moves alike, and forces along the reversed normals change sign."""
    rng = np.random.default_rng(seed)
    grasp = hand_like_grasp(rng)
    root = rng.normal(size=(grasp.n_l, grasp.n_l))
    forces = rng.normal(size=grasp.n_l)
    start = {"lambda_0": forces, "w_0": -grasp.G @ forces}
    grasp = replace(grasp, C_s=frozen(grasp.C_s + 1e-5 * root @ root.T), **start)
    grasp = replace(grasp, w_0=frozen(-grasp.G @ grasp.lambda_0))
    chosen = tuple(rng.permutation(grasp.n_c)[:2].tolist())
    other = reversed_normals(grasp, chosen)
    signs = np.ones(grasp.n_l)
    signs[[grasp.normal_rows[i] for i in chosen]] = -1
    one, two = respond(grasp), respond(other)
    assert two.du_dzr == pytest.approx(one.du_dzr, rel=1e-8, abs=1e-10)
    assert two.dlambda_dzr == pytest.approx(signs[:, None] * one.dlambda_dzr, rel=1e-7, abs=1e-7)
    assert two.dlambda_dw == pytest.approx(signs[:, None] * one.dlambda_dw, rel=1e-7, abs=1e-7)
    assert other.lambda_0 == pytest.approx(signs * grasp.lambda_0)
    twice = reversed_normals(other, chosen)
    assert all(np.array_equal(getattr(twice, name), getattr(grasp, name)) for name in ("G", "J", "C_s", "lambda_0"))


@pytest.mark.parametrize("chosen", [(2,), (0, 1), (0, 2, 4)])
def test_some_of_many_contacts_are_found_by_where_they_point(chosen: tuple[int, ...], tmp_path: Path) -> None:
    """Six slippery contacts on a ball: of all 63 sets, those that point away from the middle are the one to try."""
    normals = np.vstack([np.eye(3), -np.eye(3)])
    contacts = [{"name": f"C{i}", "kind": "hard", "friction": 0.05, "point_m": (-0.03 * n).tolist(),
                 "normal": n.tolist()} for i, n in enumerate(normals)]  # fmt: skip
    made = tuple(
        Contact(name=c["name"], kind=made_kind("hard", 0.05, 0.0), point=frozen(-0.03 * n), frame=contact_frame(n))
        for c, n in zip(contacts, normals, strict=True)
    )
    S = np.zeros((18, 6))
    S[3 * np.arange(6), np.arange(6)] = 1
    G, J = grasp_matrix(made).tolist(), np.eye(18).tolist()
    data = {"schema": 1, "contacts": contacts, "G": G, "J": J, "S": S.tolist(), "C_s": 1e-4}
    problem = 'schema = 1\ngrasp = { file = "six.json" }\ntask = { wrench = [0, 0, -0.4, 0, 0, 0] }\n'
    (tmp_path / "six.toml").write_text(problem + 'limits = { normal_force = ["1 N", "9 N"] }\n')

    def planned(file: Grasps) -> Outcome:
        (tmp_path / "six.json").write_text(json.dumps(file))
        read = load_problem(tmp_path / "six.toml")
        return plan(read.grasp, read.task)

    assert isinstance(planned(data), Plan)
    outcome = planned(turned(data, chosen))
    assert isinstance(outcome, Infeasible)
    (hint,) = outcome.hints
    assert [i for i in range(6) if f"'C{i}'" in hint] == list(chosen)
    assert isinstance(planned(follow(turned(data, chosen), hint)), Plan)


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


@pytest.mark.parametrize("name", sorted(KINDS))
def test_a_normal_the_other_way_reverses_pushing_and_nothing_that_friction_holds(name: str) -> None:
    kind = made_kind(name, 0.5, 0.004, **{each.name: 0.007 if each.length else 0.3 for each in PARAMETERS.values()
                                          if each.name not in ("friction", "spin_friction")})  # fmt: skip
    frame = contact_frame(np.array([1.0, 0.2, 0.1]))
    points = np.vstack([np.zeros(3), 0.02 * np.eye(3)[1:]])
    contacts = [Contact(name=f"C{i}", kind=kind, point=point, frame=frame) for i, point in enumerate(points)]
    grasp = driven(contacts)
    other = reversed_normals(grasp, (1,))
    rng, rows = np.random.default_rng(0), grasp.rows[1]
    for force in rng.normal(size=(20, kind.selection.shape[0])):
        turned = force * ([-1] + [1] * (len(force) - 1))
        np.testing.assert_allclose(other.G[:, rows] @ turned, grasp.G[:, rows] @ force, atol=1e-15)
        assert other.contacts[1].slip_margin(force) == grasp.contacts[1].slip_margin(force)
