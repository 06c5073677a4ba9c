"""Samples of a grasp on a hand: as large as stated, at rest at the start, and executed as a second program does."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from second_execution import executed

import synergrip as sg
from synergrip.conic.departure import off_place
from synergrip.equilibrium.balance import Balance
from synergrip.equilibrium.setting import Setting
from synergrip.linalg import Array
from synergrip.planning.executing import Executor
from synergrip.planning.outcome import Plan
from synergrip.reports.data.json_plan import outcome_document
from synergrip.tasks.scenario_on_hand import OffTheFaceError

REPOSITORY = Path(__file__).parents[2]
SCENARIOS = sg.Scenarios(position=1e-3, normal=np.radians(3), compliance=0.2)


def planned(name: str, *overrides: str) -> Plan:
    problem = sg.load_problem(name, ["task.knots=3", *overrides])
    made = sg.plan(problem.grasp, problem.task)
    assert isinstance(made, Plan)
    return made


def run(made: Plan, own: Setting) -> sg.Execution:
    assert made.executed is not None
    executor = replace(Executor.of(made.analysis, made.task), setting=own)
    found = executor.run(made.time, made.dz_r, made.task.wrench, made.executed.states)
    assert found.whole
    return found


def written(made: Plan, own: Setting) -> dict[str, Any]:
    """The document of a plan with another grasp in it."""
    document: dict[str, Any] = json.loads(json.dumps(outcome_document("", made.grasp, made)))
    block, grasp = document["execution"], own.grasp
    each = zip(block["contacts"], grasp.contacts, grasp.rows, own.held.touches, strict=True)
    for told, contact, rows, touch in each:
        told |= {"point_m": (contact.point + own.held.body.position).tolist(), "frame": contact.frame.T.tolist(),
                 "compliance": grasp.C_s[rows, rows].tolist(), "pad_centre_m": touch.pad.point.tolist()}  # fmt: skip
    early = np.broadcast_to(own.early, grasp.n_l)
    block |= {"lambda_0": own.forces.tolist(), "C_q": grasp.C_q.tolist(), "C_z": grasp.C_z.tolist(),
              "early_m": early.tolist()}  # fmt: skip
    return document


@pytest.mark.parametrize("name", ["gripper-box", "barrett-ball-hold"])
def test_a_second_program_finds_the_same_forces(name: str) -> None:
    """Tilted, shifted, with other compliances, and contacts early and late: pads that roll, and ones that stick."""
    made = planned(name)
    own = SCENARIOS.on_hand(made.grasp, 0, 1)
    early = np.zeros(own.grasp.n_l)
    early[own.grasp.normal_rows] = 5e-5 * np.array([1, -0.3, 0.6])[: own.grasp.n_c]
    own = replace(own, early=early)
    found, second = run(made, own), executed(written(made, own), REPOSITORY)
    assert made.executed is not None
    changed = np.abs(found.states.forces - made.executed.states.forces).max()
    assert changed > 0.1
    assert second.forces == pytest.approx(found.states.forces, rel=0, abs=2e-3 * changed)


@pytest.mark.parametrize("name", ["gripper-box", "barrett-ball-hold", "table2-soft-motors"])
def test_a_sample_is_as_far_off_as_stated_and_at_rest_at_the_start(name: str) -> None:
    grasp = sg.load_problem(name).grasp.replace(w_0=[0, 0, -2, 0, 0, 0])
    held = grasp.held
    assert held is not None
    moved, tilts = list[float](), list[float]()
    for number in range(40):
        own = SCENARIOS.on_hand(grasp, 0, number)
        at_rest = Balance.of(own, own.start, sg.Loads.of(grasp.w_0[None]), np.zeros((1, grasp.n_z)))
        assert at_rest.residuals[2] == pytest.approx(0.0, abs=1e-6)  # pads are as near the surface as they are placed
        assert at_rest.residuals[0] == pytest.approx(0.0, abs=1e-12)
        for contact, stated in zip(own.grasp.contacts, grasp.contacts, strict=True):
            moved.append(float(np.linalg.norm(contact.point - stated.point)))
            normal = stated.normal
            if held.body.shape is not None:
                distance, outward = held.body.shape.surface(contact.point)
                assert abs(distance) == pytest.approx(abs(held.body.shape.surface(stated.point)[0]), abs=1e-9)
                normal = -outward
            tilts.append(float(np.arccos(np.clip(contact.normal @ normal, -1, 1))))
        assert own.grasp.C_s == pytest.approx(grasp.C_s * (own.grasp.C_s[0, 0] / grasp.C_s[0, 0]))
    assert 0.95e-3 < max(moved) < 1.001e-3
    assert np.mean(np.array(moved) < 1e-3 / np.sqrt(2)) == pytest.approx(0.5, abs=0.15)  # evenly over the disc
    assert 0.9 * SCENARIOS.normal < max(tilts) <= SCENARIOS.normal + 1e-6


def drawn(scenarios: sg.Scenarios, part: int, number: int) -> Array:
    own = scenarios.on_hand(sg.load_problem("gripper-box").grasp, part, number)
    return np.concatenate([contact.point for contact in own.grasp.contacts])


def test_equal_seeds_draw_equal_samples_and_parts_have_nothing_in_common() -> None:
    again = drawn(sg.Scenarios(position=1e-3), 1, 7)
    assert np.array_equal(again, drawn(sg.Scenarios(position=1e-3), 1, 7))
    others = [(0, 7, 0), (1, 8, 0), (2, 7, 0), (7, 1, 0), (1, 7, 1)]
    for part, number, seed in others:
        assert np.abs(again - drawn(sg.Scenarios(position=1e-3, seed=seed), part, number)).max() > 1e-6


def test_a_contact_beyond_the_edge_of_its_face_is_no_sample() -> None:
    grasp = sg.load_problem("gripper-box").grasp
    wide, off = sg.Scenarios(position=0.06), 0
    for number in range(20):
        try:
            wide.on_hand(grasp, 0, number)
        except OffTheFaceError as error:
            off += "beyond the edge of its face" in str(error)
    assert 10 < off < 20  # faces of 30 by 60 mm


def test_small_gaps_change_forces_as_the_maps_of_the_knots_say() -> None:
    """d(forces)/dg of the true equilibrium is (I - G+ G) K: by differences."""
    made = planned("barrett-ball-hold")
    assert made.executed is not None
    own = made.executed.setting
    each = made.executed.balance
    for i, row in enumerate(made.grasp.normal_rows):
        early = np.zeros(made.grasp.n_l)
        early[row] = 1e-7
        one, other = (run(made, replace(own, early=sign * early)).states.forces for sign in (1, -1))
        inverse = each.inverse[:, : made.grasp.n_l, row]
        assert (one - other) / 2e-7 == pytest.approx(inverse, rel=1e-5, abs=1e-3 * np.abs(inverse).max())
        gaps = np.eye(made.grasp.n_c)[i] * 1e-7
        linear = off_place(lambda of: of(made.analysis), made.grasp, gaps)[0].force / 1e-7  # type: ignore[arg-type]
        assert (one - other)[0] / 2e-7 == pytest.approx(linear[0], rel=0, abs=0.05 * np.abs(linear).max())
