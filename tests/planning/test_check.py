"""References judged against a problem: ours pass, tampered ones fail the check that they break and no other."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from synergrip.errors import InputError, MotionDirectionError, NotRestrainedError
from synergrip.linalg import Array, frozen
from synergrip.planning.arrays import columns_of
from synergrip.planning.check import Judgement, judge_references
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.planning.references import References, read_references
from synergrip.problems.problem import Problem, load_problem
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.data.plan_files import plan_csv, write_outcome
from synergrip.tasks.timed_task import Target

TRIPOD = (
    "tripod", "goal={minimise='effort'}", "limits={margin='1 N', normal_force='20 N', joint_torque=4}",
)  # fmt: skip
RATE = 0.03


@cache
def _solved(name: str, *overrides: str) -> tuple[Problem, Plan]:
    problem = load_problem(name, overrides)
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    return problem, outcome


def _judged(problem: Problem, times: Array, dz_r: Array) -> Judgement:
    return judge_references(problem.grasp, problem.timed, References(frozen(times), frozen(dz_r), {}))


def _failed(judgement: Judgement) -> list[str]:
    return [check.name for check in judgement.checks if not check.passed]


def _rebuilt(outcome: Plan, squeeze: float = 1.0, follow: float = 1.0) -> Array:
    """The references of a plan with its internal forces and its motion multiplied."""
    return outcome.analysis.coordinates.references(squeeze * outcome.alpha, follow * outcome.beta, outcome.gamma)


@pytest.mark.parametrize("name", ["tripod", "pinch-soft", "barrett-ball-hold", "barrett-ball-roll"])
@pytest.mark.parametrize("form", ["plan.json", "plan.csv", "plan.npz", "."])
def test_our_own_plan_passes_from_every_file(name: str, form: str, tmp_path: Path) -> None:
    problem, outcome = _solved(name)
    write_outcome(tmp_path, outcome_document("", problem.grasp, outcome), outcome, ("json", "csv", "npz"))
    references = read_references(tmp_path / form, problem.grasp)
    judgement = judge_references(problem.grasp, problem.timed, references)
    assert (judgement.verdict, judgement.exit_code, _failed(judgement)) == ("feasible", 0, [])
    assert judgement.motion.times == pytest.approx(problem.timed.times, abs=1e-12)
    assert judgement.margins == pytest.approx(outcome.margins, abs=1e-9)
    assert {"slip margin", "rigid motion [m]", "equilibrium"} <= {check.name for check in judgement.checks}


def test_the_references_of_the_tripod_pass_before_they_are_tampered_with() -> None:
    problem, outcome = _solved(*TRIPOD)
    assert _failed(_judged(problem, problem.timed.times, _rebuilt(outcome))) == []


@pytest.mark.parametrize(
    ("squeeze", "follow", "broken"),
    [
        (0.99, 1.0, ["slip margin"]),
        (-1.0, 1.0, ["slip margin", "normal force"]),
        (2.0, 1.0, ["joint torque"]),
        (1.0, 1.001, ["rigid motion [m]"]),
        (1.0, 0.0, ["rigid motion [m]"]),
        (0.5, 1.1, ["rigid motion [m]", "slip margin"]),
    ],
)
def test_tampered_references_fail_the_check_they_break(squeeze: float, follow: float, broken: list[str]) -> None:
    problem, outcome = _solved(*TRIPOD)
    judgement = _judged(problem, problem.timed.times, _rebuilt(outcome, squeeze, follow))
    assert _failed(judgement) == broken
    assert (judgement.verdict, judgement.exit_code) == ("fails", 1)


def test_the_tolerance_of_the_task_is_that_of_the_tracking() -> None:
    problem, outcome = _solved(*TRIPOD)
    references = References(problem.timed.times, frozen(_rebuilt(outcome, follow=1.01)), {})  # off by 64 micrometres
    for tolerance, broken in ((1e-4, []), (1e-5, ["rigid motion [m]"])):
        judgement = judge_references(problem.grasp, replace(problem.timed, tolerance=tolerance), references)
        assert _failed(judgement) == broken


@pytest.mark.parametrize("times", [[0.0, 2.0], [0.0, 0.3333, 1.0], np.linspace(0, 1, 7), [-1.0, 0.5, 1.5]])
def test_references_of_another_time_grid_are_judged_at_the_knots_of_both(times: list[float]) -> None:
    problem, outcome = _solved("pinch-soft", "task.duration=1 s", "task.knots=4")
    dz_r = np.tile(outcome.motion.dz_r[0], (len(times), 1))
    judgement = _judged(problem, np.array(times), dz_r)
    inside = [t for t in times if 0 <= t <= 1]
    assert judgement.motion.times == pytest.approx(np.union1d(problem.timed.times, inside), abs=1e-9)
    assert _failed(judgement) == []


def test_a_slip_between_the_knots_of_the_task_is_seen() -> None:
    problem, outcome = _solved(*TRIPOD)
    weak = _rebuilt(outcome, squeeze=0.5)
    dz_r, times = outcome.motion.dz_r, problem.timed.times
    between = (times[5] + times[6]) / 2
    dz_r = np.insert(dz_r, 6, (weak[5] + weak[6]) / 2, axis=0)
    judgement = _judged(problem, np.insert(times, 6, between), dz_r)
    assert _failed(judgement) == ["slip margin"]
    k, _ = judgement.usages[0].worst()
    assert judgement.motion.times[k] == pytest.approx(between)


def test_a_motion_that_cuts_the_corners_is_seen() -> None:
    """Every second knot is too coarse for a minimum-jerk course."""
    problem, outcome = _solved(*TRIPOD)
    assert _failed(_judged(problem, problem.timed.times[::2], outcome.motion.dz_r[::2])) == ["rigid motion [m]"]


def test_a_csv_file_with_few_digits_passes_also_under_a_rate_limit(tmp_path: Path) -> None:
    """Knots 0.3 and 0.30000000000000004 are one: no rate is taken between them."""
    problem, outcome = _solved("pinch-soft", "task.knots=11", f"limits.synergy_rate={RATE}", "limits.margin=0.4 N")
    times = problem.timed.times
    assert any(float(f"{t:.3f}") != t for t in times)
    rows = [f"{t:.3f},{z[0] + 1e-6:.6f}" for t, z in zip(times, outcome.motion.dz_r, strict=True)]
    path = tmp_path / "short.csv"
    path.write_text("\n".join(["t_s,zr_1", *rows]), encoding="utf-8")
    judgement = judge_references(problem.grasp, problem.timed, read_references(path, problem.grasp))
    assert _failed(judgement) == []
    assert len(judgement.motion.times) == 11
    assert any(usage.title == "synergy rate" for usage in judgement.usages)


def test_a_step_that_is_too_fast_fails_the_rate() -> None:
    problem, outcome = _solved("pinch-soft", "task.knots=11", f"limits.synergy_rate={RATE}", "limits.margin=0.4 N")
    dz_r = np.array(outcome.motion.dz_r)
    dz_r[5:] += 1.1 * RATE * 0.1
    assert _failed(_judged(problem, problem.timed.times, dz_r)) == ["synergy rate"]


@pytest.mark.parametrize("times", [[0.0, 0.9], [0.1, 1.0]])
def test_references_that_do_not_cover_the_task_are_refused(times: list[float]) -> None:
    problem, _ = _solved("tripod")
    with pytest.raises(InputError) as caught:
        _judged(problem, np.array(times), np.zeros((2, 4)))
    assert caught.value.issues[0].key == "PLAN"
    assert f"the plan covers {times[0]:g} s to {times[1]:g} s, the task 0 s to 1 s" in caught.value.issues[0].message


def test_a_task_that_no_references_can_do_is_a_refusal() -> None:
    problem, _ = _solved("tripod")
    sideways = np.outer(problem.timed.times, [0.01, 0, 0, 0, 0, 0])
    task = replace(problem.timed, target=Target("motion", frozen(sideways), "task.motion"))
    with pytest.raises(MotionDirectionError):
        judge_references(problem.grasp, task, References(task.times, frozen(np.zeros((11, 4))), {}))
    loose = load_problem("pinch-hard")
    with pytest.raises(NotRestrainedError):
        _judged(loose, np.array([0.0, 1.0]), np.zeros((2, 1)))


ONE = load_problem("pinch-soft").grasp
"""With one synergy."""


def _written(folder: Path, name: str, text: str) -> Path:
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def test_references_of_another_hand_are_refused(tmp_path: Path) -> None:
    problem, outcome = _solved("tripod")
    path = _written(tmp_path, "plan.csv", plan_csv(outcome))
    assert read_references(path, problem.grasp).values.shape == (11, 4)
    with pytest.raises(InputError, match=r"references of .* are zr_z1, zr_z2, zr_z3, zr_z4; the grasp's are zr_z1, or"):
        read_references(path, ONE)
    numbered = _written(tmp_path, "numbered.csv", "t_s,zr_1,zr_2\n0,0,0\n")
    with pytest.raises(InputError, match="has 2 synergy references, the grasp has n_z = 1"):
        read_references(numbered, ONE)


@pytest.mark.parametrize("name", ["tripod", "barrett-ball-hold", "gripper-box"])
def test_references_by_name_or_by_number_in_any_order_of_columns(name: str, tmp_path: Path) -> None:
    problem, outcome = _solved(name)
    names = columns_of(problem.grasp)["dz_r"]
    values = np.column_stack([outcome.time, outcome.dz_r])
    for number, header in enumerate((names, [f"zr_{i + 1}" for i in range(len(names))])):
        for order in ([0, *range(1, values.shape[1])], [*reversed(range(values.shape[1]))]):
            every = ["t_s", *header]
            rows = [",".join(every[i] for i in order), *(",".join(map(repr, row[order].tolist())) for row in values)]
            path = _written(tmp_path, f"{number}.csv", "\n".join(rows))
            assert np.array_equal(read_references(path, problem.grasp).values, outcome.dz_r)


def test_columns_carry_units_and_names() -> None:
    barrett = load_problem("barrett-ball-hold").grasp
    assert columns_of(barrett)["dz_r"] == tuple(f"zr_{name}_rad" for name in barrett.synergies)
    assert columns_of(barrett)["tau"] == tuple(f"tau_{name}_Nm" for name in barrett.joints)
    assert barrett.held is not None
    hand = barrett.held.hand
    sliding = replace(hand, joints=tuple(replace(joint, kind="slide") for joint in hand.joints))
    slides = replace(barrett, held=replace(barrett.held, hand=sliding))
    assert columns_of(slides)["dz_r"] == tuple(f"zr_{name}_m" for name in barrett.synergies)
    assert columns_of(slides)["tau"] == tuple(f"tau_{name}_N" for name in barrett.joints)
    assert columns_of(load_problem("tripod").grasp)["dz_r"] == ("zr_z1", "zr_z2", "zr_z3", "zr_z4")


@pytest.mark.parametrize(
    ("name", "text", "fragment"),
    [
        ("plan.txt", "", "expected a folder, or a file .json, .npz or .csv"),
        ("plan.json", '{"verdict": "infeasible"}', "its verdict is 'infeasible'"),
        ("plan.json", "{}", "dz_r and time_s are missing"),
        ("plan.json", '{"time_s": [0, 1], "dz_r": [[0], [0, 1]]}', "dz_r is no array of numbers"),
        ("plan.json", '{"time_s": [0, 1], "dz_r": [[0]]}', "dz_r has 1 rows for 2 times"),
        ("plan.json", '{"time_s": [], "dz_r": []}', "expected time_s as (T) numbers"),
        ("plan.json", '{"time_s": [1, 0], "dz_r": [[0], [0]]}', "times must increase"),
        ("plan.json", '{"time_s": [0], "dz_r": [[null]]}', "all finite"),
        ("plan.json", "{", "not valid JSON"),
        ("plan.npz", "no archive", "is no .npz archive"),
        ("plan.csv", "t_s,zr_2\n0,1\n", "missing column 'zr_1'"),
        ("plan.csv", "t_s,zr_1\n0,x\n", "expected a number, got 'x'"),
    ],
)
def test_what_is_no_plan_is_refused(name: str, text: str, fragment: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        read_references(_written(tmp_path, name, text), ONE)
    assert fragment in caught.value.issues[0].message


@pytest.mark.parametrize("name", ["gone.json", "gone.csv", "gone", "."])
def test_a_plan_that_is_not_there_is_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        read_references(tmp_path / name, ONE)
    assert caught.value.issues[0].key == "PLAN"


def test_an_archive_of_other_things_is_refused(tmp_path: Path) -> None:
    np.savez(tmp_path / "plan.npz", q=np.zeros(3))
    with pytest.raises(InputError, match="dz_r and time_s are missing"):
        read_references(tmp_path / "plan.npz", ONE)
    np.savez(tmp_path / "plan.npz", time_s=np.array([object()]), dz_r=np.zeros((1, 1)))
    with pytest.raises(InputError, match="archive of plain arrays"):
        read_references(tmp_path / "plan.npz", ONE)


def test_forces_that_a_file_claims_are_compared_with_those_it_would_produce(tmp_path: Path) -> None:
    problem = load_problem("tripod")
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    document = outcome_document("", problem.grasp, outcome)
    del document["digest"]  # which would see it, too
    for name, passes in ((None, True), ("lambda", False), ("tau", False), ("du", False)):
        told = json.loads(json.dumps(document))
        if name:
            told[name][3][0] += 0.01
        (tmp_path / "plan.json").write_text(json.dumps(told))
        judgement = judge_references(problem.grasp, problem.timed, read_references(tmp_path, problem.grasp))
        failed = [check.name for check in judgement.checks if not check.passed]
        assert failed == ([] if passes else [f"claimed {name}"])


def test_a_claim_of_another_size_fails(tmp_path: Path) -> None:
    problem = load_problem("tripod")
    references = References(problem.timed.times, frozen(np.zeros((11, 4))), {"tau": frozen(np.zeros((11, 2)))})
    failed = [c.name for c in judge_references(problem.grasp, problem.timed, references).checks if not c.passed]
    assert "claimed tau" in failed
