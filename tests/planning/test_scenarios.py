"""Scenarios: a plan holds in its own samples, and in all but the stated share of others."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from small_grasps import tripod

import synergrip as sg
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.planning.outcome import Plan
from synergrip.reports.data.json_plan import outcome_document
from synergrip.statics import Response
from synergrip.statics.shifts import EVEN

WEIGHT = sg.Wrench((0, 0, -3.0, 0, 0, 0))
SCENARIOS = sg.Scenarios(position=3e-3, normal=0.1, compliance=0.3, share=0.1, confidence=0.99, seed=4)
TASK = sg.Task(
    loads=[WEIGHT], limits=[sg.SlipMargin(0.1), sg.NormalForce(upper=20.0)], goals=[sg.LeastEffort()], knots=1,
    allow=sg.Allowances(scenarios=SCENARIOS),
)  # fmt: skip


def planned(task: sg.Task) -> Plan:
    made = sg.plan(tripod(0.8), task)
    assert isinstance(made, Plan)
    return made


def margins(response: Response, dz_r: Array) -> Array:
    """Slip margins on a sample, by one elastic system: ``C lambda + G' u = J S dz_r``, ``G lambda = -w``."""
    grasp: Grasp = response.grasp
    C = grasp.C_s + grasp.J @ (grasp.C_q + grasp.S @ grasp.C_z @ grasp.S.T) @ grasp.J.T
    system = np.block([[EVEN * C, EVEN * grasp.G.T], [grasp.G, np.zeros((6, 6))]])
    right = np.concatenate([EVEN * grasp.J @ grasp.S @ dz_r, [0, 0, 3.0, 0, 0, 0]])
    f = np.linalg.solve(system, right)[: grasp.n_l].reshape(-1, 3)
    return np.asarray(0.8 * f[:, 0] - np.linalg.norm(f[:, 1:], axis=1))


def test_a_plan_holds_for_its_share_and_one_without_does_not() -> None:
    with_, without = planned(TASK), planned(TASK.replace(allow=None))
    allowed = with_.formulation.allowed
    assert allowed is not None
    assert len(allowed.samples) == SCENARIOS.count(with_.formulation.unknowns + 1)
    assert min(margins(each, with_.dz_r[0]).min() for each in allowed.samples) == pytest.approx(0.1, abs=1e-5)
    assert with_.cases[-1].margin == pytest.approx(0.1, abs=1e-5)
    fresh = SCENARIOS.drawn(tripod(0.8), 300, first=10_000)
    missed = [np.mean([margins(each, made.dz_r[0]).min() < 0.1 for each in fresh]) for made in (with_, without)]
    assert missed[0] <= SCENARIOS.share
    assert missed[1] > 3 * SCENARIOS.share


def test_the_largest_margin_is_that_of_the_worst_scenario_not_of_the_one_nearest_to_another_limit() -> None:
    task = TASK.replace(goals=[sg.LargestMargin()], limits=[sg.NormalForce(upper=5.0)])
    made = planned(task)
    assert made.formulation.allowed is not None
    least = min(margins(each, made.dz_r[0]).min() for each in made.formulation.allowed.samples)
    assert made.largest_margin == pytest.approx(least, abs=1e-6)
    stated, worst, *capped = made.cases
    assert worst.margin == pytest.approx(least, abs=1e-6)
    assert worst.margin < min([each.margin for each in (stated, *capped)])
    assert capped
    assert capped[0].usages[1].value.max() == pytest.approx(5.0, abs=1e-6)


@pytest.mark.parametrize(("unknowns", "share", "confidence"), [(1, 0.05, 0.999), (4, 0.1, 0.99), (45, 0.05, 0.999)])
def test_the_number_of_samples_is_the_least_that_the_bound_has(unknowns: int, share: float, confidence: float) -> None:
    """Sum over i < d of C(N, i) e^i (1 - e)^(N - i) <= 1 - confidence, added up term by term."""
    from math import exp, lgamma, log

    def tail(N: int) -> float:
        logs = (lgamma(N + 1) - lgamma(i + 1) - lgamma(N - i + 1) + i * log(share) + (N - i) * log(1 - share)
                for i in range(unknowns))  # fmt: skip
        return sum(map(exp, logs))

    N = sg.Scenarios(position=1e-3, share=share, confidence=confidence).count(unknowns)
    assert tail(N) <= 1 - confidence < tail(N - 1)


def test_a_sample_is_a_grasp_with_errors_no_larger_than_stated() -> None:
    grasp = tripod(0.8)
    shifts, tilts = list[float](), list[float]()
    for response in SCENARIOS.drawn(grasp, 50):
        for own, stated in zip(response.grasp.contacts, grasp.contacts, strict=True):
            shifts.append(float(np.linalg.norm(own.point - stated.point)))
            tilts.append(float(np.arccos(np.clip(own.normal @ stated.normal, -1.0, 1.0))))
        assert 0.7e-3 <= response.grasp.C_s[0, 0] <= 1.3e-3
    assert 2.5e-3 < max(shifts) <= 3e-3
    assert 0.08 < max(tilts) <= 0.1 + 1e-9


def test_what_no_sample_keeps_is_not_called_proven() -> None:
    peak = planned(TASK.replace(goals=[sg.LeastPeak()])).cases[-1].usages[1].value.max()
    tight = TASK.replace(limits=[sg.SlipMargin(0.1), sg.NormalForce(upper=float(0.97 * peak))])
    assert planned(tight.replace(allow=None)).verdict == "feasible"
    unsure = sg.plan(tripod(0.8), tight)
    assert isinstance(unsure, sg.Unknown)
    assert "scenarios" in unsure.why


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"position": -1e-3}, "Scenarios.position: expected a number of at least 0"),
        ({"normal": 3.0}, "Scenarios.normal: expected radians"),
        ({"compliance": 1.0}, "Scenarios.compliance: expected a share"),
        ({"position": 1e-3, "share": 1.5}, "Scenarios.share: expected a share between 0 and 1"),
        ({"position": 1e-3, "seed": -1}, "Scenarios.seed: expected a whole number"),
        ({}, "nothing is random"),
    ],
)
def test_what_are_no_scenarios(values: dict[str, Any], said: str) -> None:
    with pytest.raises(sg.InputError, match=said):
        sg.Scenarios(**values)


def test_scenarios_of_a_file_and_what_they_are_not_for() -> None:
    problem = sg.load_problem("tripod", ["task.knots=2", "allow.scenarios.position=1 mm", "allow.scenarios.share=0.2"])
    assert problem.task.allow == sg.Allowances(scenarios=sg.Scenarios(position=1e-3, share=0.2))
    made = sg.plan(problem.grasp, problem.task)
    told = outcome_document("", problem.grasp, made)["allowances"]["scenarios"]
    assert (told["share"], told["seed"]) == (0.2, 0)
    with pytest.raises(sg.InputError, match=r"allow\.scenarios"):
        sg.load_problem("tripod", ['allow.scenarios={ position = "1 mm" }', "task.between=hold"])


def test_what_is_squeezed_in_at_the_start_is_balanced_in_every_sample() -> None:
    grasp = tripod(0.8)
    squeezed = grasp.replace(lambda_0=2 * np.eye(3)[0][None].repeat(3, axis=0).ravel(), w_0=np.zeros(6))
    for response in SCENARIOS.drawn(squeezed, 5):
        own = response.grasp
        assert own.lambda_0 is not None
        assert own.G @ own.lambda_0 == pytest.approx(np.zeros(6), abs=1e-12)
        assert np.abs(own.lambda_0 - squeezed.lambda_0).max() > 1e-3
