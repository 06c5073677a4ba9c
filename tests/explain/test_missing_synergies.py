"""The fewest columns that are missing in S: what was taken away is named, and what cannot help is said not to."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from judged_missing import beyond, judged, moving_grasp
from random_grasps import random_grasp

from synergrip import load_problem, plan
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.errors import InputError
from synergrip.explain.synergies.missing_synergies import missing_synergies
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.other_synergies import chosen, extended
from synergrip.linalg import Array, frozen
from synergrip.planning.outcome import Infeasible, Outcome
from synergrip.reports.data.json_missing import missing_document
from synergrip.statics.analysis import analyse
from synergrip.statics.response import respond
from synergrip.tasks.timed_task import Target, TimedTask, still

TIMES = frozen([0.0, 0.5, 1.0])


def wish(grasp: Grasp, twists: Array, tolerance: float = 0.0) -> TimedTask:
    """The motion from 0 to each of two twists (6, 2)."""
    values = np.vstack([np.zeros(6), twists.T])
    loads = frozen(np.tile(grasp.w_0, (3, 1)))
    return TimedTask(TIMES, loads, Target("motion", frozen(values)), 0.0, (), (LeastEffort(),), tolerance=tolerance)


def refused(grasp: Grasp, task: TimedTask) -> Infeasible:
    no = plan(grasp, task)
    assert isinstance(no, Infeasible), no
    return no


@pytest.mark.parametrize("seed", range(12))
def test_what_was_taken_from_S_is_named(seed: int) -> None:
    assert judged(seed) == ""


@pytest.fixture(scope="module")
def able() -> Grasp:
    """A grasp whose 14 joints together can do anything, with 3 synergies that cannot move the object."""
    return random_grasp(np.random.default_rng(4), ["hard"] * 4, n_q=14, n_z=3)


def test_a_wish_in_two_directions_takes_two_columns_and_within_a_tolerance_one(able: Grasp) -> None:
    along, across = 1e-3 * np.eye(6)[0], 1e-3 * np.eye(6)[1]
    missing = missing_synergies(refused(able, wish(able, np.column_stack([along, across]))))
    assert (missing.count, missing.proven, missing.columns.shape) == (2, True, (14, 2))
    nearly = wish(able, np.column_stack([along, along + 0.01 * across]), tolerance=2e-5)
    missing = missing_synergies(refused(able, nearly))
    assert (missing.count, missing.proven) == (1, True)
    assert missing.verdict == "feasible"
    exactly = replace(nearly, tolerance=0.0)
    assert missing_synergies(refused(able, exactly)).count == 2


def test_a_motion_that_the_first_column_frees_counts_once(able: Grasp) -> None:
    """Of a wish in two directions, one of which is free already, one is missing."""
    twists = 1e-3 * np.eye(6)[:, :2]
    column = np.linalg.lstsq(able.J, able.G.T @ twists[:, :1], rcond=None)[0]
    grasp = extended(able, ["x"], column)
    assert missing_synergies(refused(grasp, wish(grasp, twists))).count == 1


def test_more_motions_than_synergies_is_a_lack_too(able: Grasp) -> None:
    one = chosen(able, [0])
    no = refused(one, wish(one, 1e-3 * np.eye(6)[:, :2]))
    assert no.stage == "count"
    assert missing_synergies(no).count == 2


def test_on_some_axes_only_these_count(able: Grasp) -> None:
    task = replace(wish(able, 1e-3 * np.eye(6)[:, :2]), axes=("y",))
    missing = missing_synergies(refused(able, task))
    assert (missing.count, missing.verdict) == (1, "feasible")


def test_columns_are_of_least_norm(able: Grasp) -> None:
    """Any other column that frees the same motion is longer."""
    twist = 1e-3 * np.eye(6)[:, [0, 0]]
    missing = missing_synergies(refused(able, wish(able, twist)))
    (x,) = missing.columns.T
    rng = np.random.default_rng(0)
    nothing = np.linalg.svd(able.J)[2][12:].T  # joint motions that move no contact
    inside = np.linalg.lstsq(able.J, able.J @ able.S, rcond=None)[0]
    for _ in range(20):
        other = x + nothing @ rng.normal(size=2) + inside @ rng.normal(size=3)
        assert np.linalg.norm(other) > 1.0
    assert np.abs(x @ np.column_stack([nothing, inside])).max() < 1e-9


def test_directions_of_force_are_named_modulo_what_moves_the_object(able: Grasp) -> None:
    left = chosen(able, [0, 1])
    asked = analyse(able).spaces.E_s
    lost = beyond(asked, analyse(left).spaces.E_s)
    assert lost.shape[1] == 1
    no = refused(left, wish(left, 1e-3 * np.eye(6)[:, [0, 0]]))
    missing = missing_synergies(no, forces=lost)
    assert missing.count == 2  # one for the motion, one for the force
    spaces = analyse(extended(left, ["a", "b"], missing.columns)).spaces
    assert beyond(lost, spaces.E_s).shape[1] == 0
    assert spaces.Gamma_ucs.shape[1] == 1


def test_what_all_joints_cannot_do_no_synergies_can() -> None:
    grasp = random_grasp(np.random.default_rng(5), ["hard"] * 3, n_q=5, n_z=3)
    missing = missing_synergies(refused(grasp, wish(grasp, 1e-3 * np.eye(6)[:, [0, 0]])))
    assert (missing.count, missing.proven, missing.candidates, missing.columns.shape) == (None, True, (), (5, 0))
    assert "all 5 joints" in missing.why


def test_where_limits_are_in_the_way_all_joints_tell_whether_synergies_help(able: Grasp) -> None:
    """One synergy moves nothing that presses on the object; a load beyond a cap no synergy carries."""
    loads = frozen([[0, 0, -2.0, 0, 0, 0]] * 3)
    held = TimedTask(TIMES, loads, still(TIMES), 0.0, (NormalForce(0.0, 50.0),), (LeastEffort(),))
    few = replace(chosen(able, [0]), C_s=frozen(1e-3 * np.eye(12)), C_q=0.0, C_z=0.0)
    no = refused(few, held)
    missing = missing_synergies(no)
    assert no.stage == "magnitude"
    assert missing.count
    assert missing.verdict == "feasible"
    assert all(each.verdict == "feasible" for each in missing.candidates)
    no = refused(few, replace(held, limits=(NormalForce(0.0, 0.01),)))
    missing = missing_synergies(no)
    assert (missing.count, missing.proven) == (None, True)


def test_where_no_joint_has_the_column_the_fewest_together_do(able: Grasp) -> None:
    """Of 12 contact motions 3 are in the range of J S: it takes 9 joints that move all of them to make any other."""
    missing = missing_synergies(refused(able, wish(able, 1e-3 * np.eye(6)[:, [0, 0]])), most=2)
    assert missing.count == 1
    assert [(each.set, len(each.names), each.verdict) for each in missing.candidates] == [("joints", 9, "feasible")] * 2
    assert "more candidates" in missing.notes[-1]


def test_the_document_holds_what_the_value_does(able: Grasp) -> None:
    missing = missing_synergies(refused(able, wish(able, 1e-3 * np.eye(6)[:, [0, 1]])), most=1)
    document = json.loads(json.dumps(missing_document(missing)))
    assert document["count"] == 2
    assert np.array_equal(document["columns"], missing.columns)
    assert document["candidates"][0]["names"] == list(missing.candidates[0].names)


def test_a_wish_in_modes_is_that_of_the_synergies_there_are() -> None:
    """Further synergies have other modes; what is wanted of the object stays."""
    grasp = moving_grasp(np.random.default_rng(1))
    modes = Target("modes", frozen(1e-3 * np.ones((3, analyse(grasp).spaces.Gamma_ucs.shape[1]))))
    loads = frozen([[0, 0, -5.0, 0, 0, 0]] * 3)
    task = TimedTask(TIMES, loads, modes, 0.0, (NormalForce(0.0, 50.0),), (LeastEffort(),))
    missing = missing_synergies(refused(grasp, task), most=2)
    assert (missing.count, missing.verdict) == (1, "feasible")
    assert [each.verdict for each in missing.candidates] == ["feasible"] * 2


@pytest.fixture(scope="module")
def glass() -> Infeasible:
    problem = load_problem("human-glass", "hand.synergies=4")
    no = plan(problem.grasp, problem.task)
    assert isinstance(no, Infeasible)
    return no


def test_a_candidate_of_the_same_set_says_what_to_write(glass: Infeasible) -> None:
    missing = missing_synergies(glass, most=2)
    pc6 = missing.candidates[0]
    assert (missing.count, pc6.set, pc6.names, pc6.verdict) == (1, "santello", ("pc6",), "feasible")
    problem = load_problem("human-glass", pc6.setting)
    assert problem.grasp.n_z == 5
    assert plan(problem.grasp, problem.task).verdict == pc6.verdict


def test_an_interrupt_keeps_the_candidates_that_are_judged(glass: Infeasible) -> None:
    judged = list[Grasp]()

    def interrupted(grasp: Grasp, task: TimedTask) -> Outcome:
        judged.append(grasp)
        if len(judged) == 3:  # the columns of no file, one candidate, and then
            raise KeyboardInterrupt
        return plan(grasp, task)

    missing = missing_synergies(glass, judge=interrupted)
    assert len(missing.candidates) == 1
    assert "interrupted" in missing.notes[-1]


def test_further_synergies_leave_what_a_grasp_can_do() -> None:
    grasp = moving_grasp(np.random.default_rng(1))
    more = extended(grasp, [grasp.synergies[0]], np.ones((grasp.n_q, 1)))
    assert len(set(more.synergies)) == more.n_z == grasp.n_z + 1
    old, new = respond(grasp), respond(more)
    np.testing.assert_allclose(new.dlambda_dzr[:, :-1], old.dlambda_dzr, atol=1e-9 * np.abs(old.dlambda_dzr).max())
    back = chosen(more, range(grasp.n_z))
    assert back == grasp


def test_wrong_arguments_are_named(glass: Infeasible) -> None:
    with pytest.raises(InputError, match="no: expected"):
        missing_synergies(load_problem("human-glass"))
    with pytest.raises(InputError, match=r"forces: .*15"):
        missing_synergies(glass, forces=np.ones((3, 1)))


def test_limits_of_synergies_go_with_them() -> None:
    limit = SynergyReference([1.0, 2.0, 3.0])
    assert limit.for_synergies([2, 0, None]).limit.tolist() == [3.0, 1.0, np.inf]
    assert SynergyReference([2.0, 2.0]).for_synergies([0, None]).limit.tolist() == [2.0, 2.0]
    with pytest.raises(InputError, match="columns"):
        extended(moving_grasp(np.random.default_rng(1)), ["x"], np.ones((1, 1)))
