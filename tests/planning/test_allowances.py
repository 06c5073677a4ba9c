"""What a task allows for: every value inside it keeps the limits, and a plan without it slips in some of them."""

from __future__ import annotations

import itertools
from dataclasses import replace
from pathlib import Path
from typing import Any

import cvxpy as cp
import numpy as np
import pytest
from allowed_samples import elastic_forces, sample, slip_margins
from command_line import run
from small_grasps import pinch, tripod

import synergrip as sg
from synergrip.changes.allowance_dials import allowance_dials
from synergrip.changes.asked import Asked
from synergrip.conic.departure import off_place
from synergrip.conic.limits.limit import Limit
from synergrip.grasps.grasp import Grasp
from synergrip.planning.formulated import formulated
from synergrip.planning.outcome import Plan
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.text.text_cases import case_lines, guaranteed_margin

WEIGHT = sg.Wrench((0, 0, -3.0, 0, 0, 0))


def planned(grasp: Grasp, task: sg.Task) -> Plan:
    made = sg.plan(grasp, task)
    assert isinstance(made, Plan)
    return made


def carried(*limits: Limit, **allow: Any) -> sg.Task:
    return sg.Task(
        loads=[WEIGHT], limits=limits, goals=[sg.LeastPeak()], knots=1,
        allow=sg.Allowances(**allow) if allow else None,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("allow", "squeeze"),
    [
        ({}, 3 / (2 * 0.5)),
        ({"friction": (0.3, 0.9)}, 3 / (2 * 0.3)),
        ({"friction": {"right": (0.4, 0.5)}}, 3 / (2 * 0.4)),
        ({"friction_share": 0.2}, 3 / (2 * 0.4)),
        ({"friction": (0.6, 0.9)}, 3 / (2 * 0.5)),  # what is stated is always one of the values
        ({"load": [(0, 0, -1, 0, 0, 0)]}, 4 / (2 * 0.5)),
        ({"load_box": (0, 0, 2, 0, 0, 0)}, 5 / (2 * 0.5)),
        ({"load_box": (1, 0, 0, 0, 0, 0)}, 3 / (2 * 0.5) + 1 / 2),  # half of it is taken off one finger
        ({"friction": (0.3, 0.9), "load": [(0, 0, -1, 0, 0, 0)]}, 4 / (2 * 0.3)),
        ({"contact_gap": 1e-4}, 3 / (2 * 0.5) + 2 * 1e-4 / 2e-3),  # (I - G+ G) K g = g / 2c, of each of two
    ],
)
def test_a_pinch_squeezes_as_its_closed_form_says(allow: dict[str, Any], squeeze: float) -> None:
    """Two fingers carry a load by friction, half each; what pushes along them goes on one and off the other."""
    made = planned(pinch(0.5), carried(**allow))
    assert made.forces[:, made.grasp.normal_rows] == pytest.approx(squeeze, rel=1e-5)
    assert not allow or min(case.margin for case in made.cases) == pytest.approx(0.0, abs=1e-5)


@pytest.mark.parametrize("limit", [sg.ActuatorEffort, sg.SustainedEffort])
def test_a_contact_that_is_early_counts_in_what_is_bound_at_once_and_in_what_is_bound_over_time(limit: Any) -> None:
    """To keep 3 N with a contact late by g it takes 3.1 N, and with one that is early that becomes 3.2 N."""
    grasp = pinch(0.5)
    least = np.abs(planned(grasp, carried()).motion.efforts).max() * 3.2 / 3
    for share, verdict in ((1.001, "feasible"), (0.999, "infeasible")):
        task = carried(limit(share * least), contact_gap=1e-4).replace(knots=3)
        assert sg.plan(grasp, task).verdict == verdict


def test_what_adds_up_over_time_is_looked_at_in_every_case() -> None:
    made = planned(pinch(0.5), carried(sg.SustainedTorque(50.0), load=[(1, 0, 0, 0, 0, 0)]).replace(knots=3))
    titles = [[usage.title for usage in case.usages] for case in made.cases]
    assert titles == [["slip margin", "sustained torque"]] * 2
    stated, pushed = (case.usages[1].value[-1].max() for case in made.cases)
    assert pushed == pytest.approx(stated + 0.5)


def allowed_tripod() -> tuple[Grasp, sg.Task]:
    """Everything that matrices can be allowed for, on fingers below the equator of a ball."""
    grasp = tripod(0.8, below=0.2)
    allow = sg.Allowances(
        friction={"C0": (0.5, 0.8)}, friction_share=0.1, load=[(0.8, 0, 0, 0, 0, 0.005), (0, -0.5, 0.3, 0, 0, 0)],
        load_box=(0, 0.2, 0.2, 0, 0, 0), contact_gap={"C1": 2e-4, "C2": 1e-4},
    )  # fmt: skip
    limits = [sg.SlipMargin(0.1), sg.NormalForce(upper=30.0), sg.JointTorque(30.0), sg.ActuatorEffort(29.0)]
    return grasp, sg.Task(loads=[WEIGHT], limits=limits, goals=[sg.LeastEffort()], knots=1, allow=allow)


def test_no_sample_slips_and_without_allowances_many_do() -> None:
    grasp, task = allowed_tripod()
    assert task.allow is not None
    with_, without = planned(grasp, task), planned(grasp, task.replace(allow=None))
    assert 0.1 < min(case.margin for case in with_.cases) < 0.13  # the reserve asks for a little more than is needed
    rng, slipped = np.random.default_rng(3), 0
    for _ in range(1000):
        drawn = sample(rng, task.allow, grasp)
        least = [
            slip_margins(
                grasp, elastic_forces(grasp, made.dz_r, made.task.wrench + drawn.load, drawn.gaps), drawn
            ).min()
            for made in (with_, without)
        ]
        assert least[0] > 0.1 - 1e-6
        slipped += least[1] < 0
    assert slipped > 300


def second_squeeze(grasp: Grasp, task: sg.Task) -> float:
    """The least sum of squares of contact forces that keeps every corner, in a model of its own (cvxpy)."""
    allow = task.allow
    assert allow is not None
    z = cp.Variable(grasp.n_z)
    bare = elastic_forces(grasp, np.zeros((1, grasp.n_z)), WEIGHT_OF_ALL, np.zeros(grasp.n_c))[0]
    of_z = elastic_forces(grasp, np.eye(grasp.n_z), WEIGHT_OF_ALL, np.zeros(grasp.n_c)).T - bare[:, None]
    limits = []
    for load in [np.zeros(6), *np.asarray(allow.load)]:
        for y, up in ((a, b) for a in (-0.2, 0.2) for b in (-0.2, 0.2)):
            for one, two in ((a, b) for a in (-2e-4, 2e-4) for b in (-1e-4, 1e-4)):
                wrench = WEIGHT_OF_ALL + load + [0, y, up, 0, 0, 0]
                f = elastic_forces(grasp, np.zeros((1, grasp.n_z)), wrench, np.array([0, one, two]))[0] + of_z @ z
                for i, mu in enumerate((0.5, 0.72, 0.72)):
                    limits += [mu * f[3 * i] - 0.1 >= cp.norm(f[3 * i + 1 : 3 * i + 3]), f[3 * i] <= 30.0]
    problem = cp.Problem(cp.Minimize(cp.sum_squares(bare + of_z @ z)), limits)
    problem.solve(solver="CLARABEL")
    return float(problem.value)


WEIGHT_OF_ALL = np.array([[0, 0, -3.0, 0, 0, 0]])


def test_as_a_second_model_has_it() -> None:
    """Exactly where all corners are cases of their own; with the reserve for contacts that are off a little more."""
    grasp, task = allowed_tripod()
    assert task.allow is not None
    exact = second_squeeze(grasp, task)
    reserved = float((planned(grasp, task).forces ** 2).sum())
    assert exact < reserved < 1.1 * exact
    timed = task.timed(grasp)
    assert timed.allowed is not None
    cornered = planned(grasp, replace(timed, allowed=replace(timed.allowed, cornered=True)))  # type: ignore[arg-type]
    assert float((cornered.forces**2).sum()) == pytest.approx(exact, rel=1e-6)


def test_a_contact_that_is_off_moves_the_forces_as_the_theory_says() -> None:
    """(I - G+ G) K g, and balanced: no wrench on the object."""
    from random_grasps import random_grasp

    grasp = random_grasp(np.random.default_rng(5))
    made = sg.analyse(grasp)
    formulation = formulated(made, sg.Task(knots=1).timed(grasp), redundancy=False)
    gaps = np.linspace(1e-4, 2e-4, grasp.n_c)
    K, G = made.response.K, grasp.G
    stiff = (np.eye(grasp.n_l) - made.response.right_inverse @ G) @ K
    for off, row, gap in zip(off_place(formulation.map_of, grasp, gaps), grasp.normal_rows, gaps, strict=True):
        assert off.force[0] == pytest.approx(stiff[:, row] * gap, rel=1e-6, abs=1e-9)
        assert G @ off.force[0] == pytest.approx(np.zeros(6), abs=1e-9)


def test_a_no_is_proven_and_says_which_allowance_would_help() -> None:
    grasp, task = pinch(0.5), carried(sg.NormalForce(upper=4.0), friction=(0.3, 0.9), contact_gap=1e-5)
    no = sg.plan(grasp, task)
    assert isinstance(no, sg.Infeasible)
    assert no.certificate.verified
    assert planned(grasp, task.replace(allow=None)).forces.max() < 4.0
    found = {repair.key: repair.to for repair in no.repairs if repair.verified}
    assert found["allow.friction"] == pytest.approx(
        3 / (2 * (4.0 - 4 * 1e-5 / 2e-3)), rel=1e-3
    )  # both ways: of the cap, too
    assert no.explain().cause in ("friction", "force_cap")


@pytest.mark.parametrize(
    ("load", "unit"), [((0, 9, 0, 0, 0, 0), "N"), ((0, 0, 0, 0, 0, 9), "N m"), ((0, 0, 9, 0, 0.1, 0), "")]
)
def test_a_load_that_is_allowed_for_is_told_in_its_unit(load: tuple[float, ...], unit: str) -> None:
    grasp, task = tripod(), sg.Task(limits=[sg.NormalForce(upper=5.0)], knots=1, allow=sg.Allowances(load=[load]))
    dials = {dial.key: dial for dial in allowance_dials(Asked.of(grasp, task, task.timed(grasp)))}
    assert (dials["allow.load"].value, dials["allow.load"].unit) == (9.0, unit)


def test_a_reserve_proves_nothing_and_corners_decide() -> None:
    """A cap at which corners have a plan and the reserve has none."""
    grasp, task = allowed_tripod()
    timed = task.timed(grasp)
    assert timed.allowed is not None
    with_reserve, least = (
        max(case.usages[1].value.max() for case in planned(grasp, each).cases)  # type: ignore[arg-type]
        for each in (
            replace(timed, goals=(sg.LeastPeak(),), allowed=replace(timed.allowed, cornered=cornered))
            for cornered in (False, True)
        )
    )
    assert with_reserve > least * (1 + 1e-3)
    for share, verdict in ((1e-4, "feasible"), (-1e-4, "infeasible")):
        limits = [sg.SlipMargin(0.1), sg.NormalForce(upper=float(least * (1 + share)))]
        assert sg.plan(grasp, task.replace(limits=limits)).verdict == verdict


HANDS = {
    "gripper-box": {"friction_share": 0.1, "mass": (0.1, 0.3), "load": [(0.2, 0, 0, 0, 0, 0)]},
    "barrett-ball-hold": {"friction_share": 0.05, "mass": (0.15, 0.22), "load": [(0, 0.1, 0, 0, 0, 0)]},
}


@pytest.mark.parametrize("name", HANDS)
def test_a_hand_keeps_its_margin_in_every_case_at_the_true_equilibrium(name: str) -> None:
    problem, allow = sg.load_problem(name, "task.knots=7"), sg.Allowances(**HANDS[name])  # type: ignore[arg-type]
    limits = [each for each in problem.task.limits if not isinstance(each, sg.NormalForce)]
    task = problem.task.replace(limits=limits)
    with_, without = planned(problem.grasp, task.replace(allow=allow)), planned(problem.grasp, task)
    asked, rng = with_.task.margin, np.random.default_rng(2)
    assert problem.held is not None
    own, missed = problem.held.body.mass, 0
    for _ in range(8):
        drawn = sample(rng, allow, problem.grasp)
        assert drawn.mass is not None
        wrench = with_.task.wrench * (drawn.mass / own) + drawn.load
        margins = []
        for made in (with_, without):
            assert made.executed is not None
            loads, near = sg.Loads.of(wrench), made.executed.states
            found = sg.execute(made.grasp, made.time, made.dz_r, loads, guess=near)
            margins.append(slip_margins(made.grasp, found.states.forces, drawn).min())
        assert margins[0] > asked - 2e-3 * max(1.0, np.abs(with_.forces).max())
        missed += margins[1] < asked - 0.02
    assert missed >= 2
    assert min(case.margin for case in with_.cases) == pytest.approx(asked, abs=1e-3 * np.abs(with_.forces).max())


def test_what_loads_really_change_is_asked_for_and_never_promised_without(monkeypatch: pytest.MonkeyPatch) -> None:
    """Loads that bend the hand, and between knots that are far apart: linear changes of the path do not hold."""
    problem = sg.load_problem("gripper-box", "task.knots=5")
    allow = sg.Allowances(load=[(0, 4, 0, 0, 0, 0), (0, 0, 4, 0, 0, 0)])
    task = problem.task.replace(allow=allow, limits=[sg.SlipMargin(0.5)])
    held = planned(problem.grasp, task)
    assert all(check.passed for check in held.checks)
    assert min(case.margin for case in held.cases) > 0.5 - 1e-3 * np.abs(held.forces).max()
    monkeypatch.setattr("synergrip.planning.walked.kept_in_cases", lambda *given: None)
    unsure = sg.plan(problem.grasp, task)
    assert isinstance(unsure, sg.Unknown)
    assert (unsure.stage, unsure.exit_code) == ("execution", 3)
    assert "in cases that are allowed for: load [0 4 0 0 0 0]" in unsure.why


def test_contacts_that_are_off_are_executed_on_the_hand() -> None:
    """Every case with contacts early and late, as an execution of its own has it."""
    problem = sg.load_problem("barrett-ball-hold", ["task.knots=3", "task.between=report"])
    made = planned(problem.grasp, problem.task.replace(allow=sg.Allowances(contact_gap=1e-4)))
    in_place, *off = made.cases
    assert made.executed is not None
    assert (in_place.title, len(off), any(case.by_maps for case in made.cases)) == ("as stated", 8, False)
    for signs, case in zip(itertools.product((1, -1), repeat=3), off, strict=True):
        early = np.zeros(made.grasp.n_l)
        early[made.grasp.normal_rows] = 1e-4 * np.array(signs)
        own = replace(made.executed.setting, early=early)
        found = sg.execute(own, made.time, made.dz_r, sg.Loads.of(made.task.wrench), guess=made.executed.states)
        assert case.usages[0].value == pytest.approx(found.margins, abs=1e-6)
        assert found.margins.min() > 0.5 - 1e-3 * np.abs(made.forces).max()


def test_of_many_cases_with_contacts_off_the_worst_are_executed(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = sg.load_problem("barrett-ball-hold", ["task.knots=3", "task.between=report"])
    task = problem.task.replace(allow=sg.Allowances(contact_gap=1e-4))
    every = planned(problem.grasp, task)
    monkeypatch.setattr("synergrip.planning.contacts_off.MOST_EXECUTED", 2)
    some = planned(problem.grasp, task)
    by_maps = [case for case in some.cases if case.by_maps]
    assert 1 < len(by_maps) < len(every.cases) - 1
    worst = min(every.cases, key=lambda case: case.margin)
    assert (worst.title, worst.margin) in [(case.title, case.margin) for case in some.cases if not case.by_maps]
    text = " ".join(" ".join(case_lines(some)).split())
    assert (
        f"in {9 - len(by_maps)} cases executed on the hand that moves, and in {len(by_maps)} with contacts off" in text
    )
    told = outcome_document("", problem.grasp, some)["allowances"]["cases"]
    assert [each["by_maps"] for each in told] == [case.by_maps for case in some.cases]


def test_what_the_file_says_code_can_say(tmp_path: Path) -> None:
    table = {"friction": {"C1": [0.5, 0.8]}, "friction_share": 0.1,
             "load": ["0.5 N along -z", [1, 0, 0, 0, 0, "1 N mm"]],
             "load_box": [0, "10 mN", 0, 0, 0, 0], "contact_gap": "0.1 mm"}  # fmt: skip
    problem = sg.load_problem({"schema": 1, "grasp": {"file": str(TRIPOD)}, "task": {"wrench": [0, 0, -2, 0, 0, 0]},
                               "limits": {"normal_force": "20 N"}, "allow": table})  # fmt: skip
    assert problem.task.allow == sg.Allowances(
        friction={"C1": (0.5, 0.8)}, friction_share=0.1, load=[(0, 0, -0.5, 0, 0, 0), (1, 0, 0, 0, 0, 1e-3)],
        load_box=(0, 0.01, 0, 0, 0, 0), contact_gap=1e-4,
    )  # fmt: skip
    document = outcome_document("", problem.grasp, sg.plan(problem.grasp, problem.task))
    told = document["allowances"]
    assert (
        len(told["cases"]) == (1 + 3 * 2) * 8
    )  # what is stated, and two loads or none at both ends of the box, with contacts off
    assert told["worst_N"] == min(each["worst_N"] for each in told["cases"])
    assert "least friction" in told["case"]


TRIPOD = Path(__file__).parents[2] / "problems" / "tripod.json"


@pytest.mark.parametrize(
    ("table", "key", "said"),
    [
        ({"friction": [0.5, 0.4]}, "allow.friction", "exceeds the largest"),
        ({"friction": [-0.5, 0.4]}, "allow.friction[0]", "greater than 0"),
        ({"friction": {"C9": [0.3, 0.4]}}, "allow.friction.C9", "'C9' is not one of"),
        ({"friction_share": 1.0}, "allow.friction_share", "less than 1"),
        ({"mass": ["0.1 kg", "0.2 kg"]}, "allow.mass", "no object"),
        ({"load": ["1 N along q"]}, "allow.load[0]", "0.5 N along x"),
        ({"load_box": [-1, 0, 0, 0, 0, 0]}, "allow.load_box", "at least 0"),
        ({"load_box": [1, 1, 1, 1, 1, 1], "load": ["1 N along x"] * 4}, "allow.load", "320 corners"),
        ({"contact_gap": "-1 mm"}, "allow.contact_gap", "at least 0"),
        ({"contact_gap": {"C9": "1 mm"}}, "allow.contact_gap.C9", "'C9' is not one of"),
        ({"load_box": [0, 0, 0, 0, 0, 0]}, "allow", "nothing is allowed for"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(table: dict[str, Any], key: str, said: str) -> None:
    with pytest.raises(sg.InputError) as caught:
        sg.load_problem({"schema": 1, "grasp": {"file": str(TRIPOD)}, "task": {"wrench": [0, 0, -2, 0, 0, 0]},
                         "limits": {"normal_force": "20 N"}, "allow": table})  # fmt: skip
    assert [(issue.key, said in issue.message) for issue in caught.value.issues] == [(key, True)]


def test_a_task_in_code_refuses_what_does_not_fit() -> None:
    problem = sg.load_problem("barrett-ball-hold")
    still = sg.Task(loads=[WEIGHT], knots=1, allow=sg.Allowances(mass=(0.1, 0.2)))
    with pytest.raises(sg.InputError, match=r"Task\.allow\.mass: another mass changes nothing"):
        still.timed(problem.grasp)
    with pytest.raises(sg.InputError, match="nothing that it allows for"):
        sg.plan(pinch(0.5), carried(load_box=(0, 0, 1, 0, 0, 0)), solver="cvxpy")
    done = run("plan", "tripod", "--set", "allow.friction_share=0.1", "--solver", "cvxpy")
    assert done.exit_code == 2
    assert "nothing that it allows for" in done.stderr


def test_between_the_knots_every_case_holds() -> None:
    """A load that swings, held between the knots: margins at many instants, in every corner."""
    grasp = tripod(0.8, below=0.2)
    push = sg.Push(force=2.0, direction="x", start=0.0, end=1.0, profile="half-sine")
    allow = sg.Allowances(friction_share=0.2, load_box=(0.3, 0.3, 0, 0, 0, 0))
    task = sg.Task(
        duration=1.0, knots=5, loads=[WEIGHT, push], limits=[sg.SlipMargin(0.1)], between="hold", allow=allow
    )
    made = planned(grasp, task)
    times = np.linspace(0, 1, 101)
    dz_r = np.array([np.interp(times, made.time, column) for column in made.dz_r.T]).T
    course = made.task.course
    assert course is not None
    load = course.load_at(times)
    assert load is not None
    rng = np.random.default_rng(1)
    for _ in range(20):
        drawn = sample(rng, allow, grasp)
        forces = elastic_forces(grasp, dz_r, load + drawn.load, np.zeros(3))
        assert slip_margins(grasp, forces, drawn).min() > 0.1 - 1e-4


def test_a_mass_interval_is_two_loads_by_which_the_weight_differs() -> None:
    """As a grasp given as matrices, which has no object, says it: ``w (m / m_0 - 1)`` for both ends."""
    grasp = sg.load_problem("gripper-box").grasp
    weight = np.array([0, 0, -9.81 * 0.2, 0, 0, 0])
    task = sg.Task(knots=1, loads=[sg.Gravity((0, 0, -9.81))], limits=[sg.SlipMargin(0.5)], linearise="once")
    both = [sg.Allowances(mass=(0.1, 0.25)), sg.Allowances(load=[-0.5 * weight, 0.25 * weight])]
    by_mass, by_load = (planned(grasp, task.replace(allow=each)) for each in both)
    assert by_load.dz_r == pytest.approx(by_mass.dz_r, rel=1e-6)
    text = "\n".join([*case_lines(by_load), guaranteed_margin(by_load)])
    assert f"as stated; {min(each.margin for each in by_load.cases):.4g} N in the worst case" in text


def test_margins_tell_the_worst_case() -> None:
    grasp, task = allowed_tripod()
    found = sg.margins(grasp, task, only=["load_factor"])
    assert isinstance(found, sg.Margins)
    assert min(case.margin for case in found.plan.cases) < found.measures["slip margin"].worst.value
    assert found.direct["load_factor"].proven
