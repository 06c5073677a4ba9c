"""Courses in time that pencil and paper give: how early a squeeze must begin, how hard it must bend, splines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Self

import numpy as np
import pytest
from named_goals import goals
from scipy.interpolate import CubicSpline
from small_grasps import pinch

from synergrip.conic.bounds import within
from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.conic.rows import Rows
from synergrip.linalg import Array, frozen
from synergrip.planning.outcome import Infeasible, Outcome, Plan
from synergrip.planning.planning import plan
from synergrip.tasks.timed_task import Target, TimedTask, still

COMPLIANCE = 1e-3  # [m/N] of each contact of the pinch: n = dz_r / COMPLIANCE
MU, MARGIN = 0.5, 0.3


@dataclass(frozen=True)
class Pinned(SynergyReference):
    """References given at some knots, and within the limit at the others."""

    values: Array = field(default_factory=lambda: np.zeros(0))  # (T,) NaN where free
    key: str = "limits.pinned"

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        free, end = np.isnan(self.values), self.limit[0]
        lower, upper = (np.where(free, sign * end, self.values)[:, None] for sign in (-1, 1))
        names = formulation.response.grasp.synergies
        return within(self.key, names, formulation.reference, lower, upper, np.full(1, COMPLIANCE))

    def loosened(self, share: float) -> Self:
        return self


def pinned(count: int, known: dict[int, float]) -> Pinned:
    """Return squeezes [N] at some of `count` knots; 1000 N at most at the others."""
    values = np.full(count, np.nan)
    values[list(known)] = np.array(list(known.values())) * COMPLIANCE
    return Pinned(frozen([1000 * COMPLIANCE]), values=frozen(values))


def asked(times: Array, weight: Array, names: tuple[str, ...], *limits: object, margin: float = MARGIN) -> Outcome:
    """Plan a pinch under a weight (T,) over time."""
    wrench = np.zeros((len(times), 6))
    wrench[:, 2] = -weight
    return plan(pinch(MU), TimedTask(frozen(times), frozen(wrench), still(times), margin, limits, goals(*names)))  # type: ignore[arg-type]


def squeeze(outcome: Outcome) -> Array:
    """Return the normal force over time (T,)."""
    assert isinstance(outcome, Plan), outcome
    assert all(decision.certificate.verified for decision in outcome.decisions)
    return np.asarray(outcome.motion.forces[:, 0])


LOADS = {
    "step": lambda t: np.where(t < 1.2, 1.0, 6.0),
    "ramp": lambda t: np.clip(8 * (t - 0.8), 0, 6),
    "bump": lambda t: 5 * np.exp(-(((t - 1.0) / 0.1) ** 2)),
}


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("even", [True, False])
def test_a_squeeze_begins_as_early_as_its_rate_asks_for(load: str, even: bool) -> None:
    """The least squeeze with rate R is the Lipschitz envelope ``n(t) = max_s need(s) - R |t - s|``, at every knot."""
    steps = np.ones(50) if even else np.random.default_rng(5).uniform(0.4, 1.6, 50)
    times = 2 * np.r_[0.0, np.cumsum(steps) / steps.sum()]
    weight, rate = LOADS[load](times), 6.0  # N/s
    found = squeeze(asked(times, weight, ("effort",), SynergyRate(frozen([rate * COMPLIANCE]))))
    need = (MARGIN + weight / 2) / MU
    envelope = (need - rate * np.abs(times[:, None] - times)).max(axis=1)
    assert np.any(envelope > need + 0.1)
    assert found == pytest.approx(envelope, rel=2e-6)


def test_a_squeeze_that_may_not_begin_early_is_refused_by_its_rate() -> None:
    """From at most 2 N before the step, in one interval, to the need after it."""
    times = np.linspace(0, 2, 21)
    weight = LOADS["step"](times)
    before, after = (MARGIN + np.array([1.0, 6.0]) / 2) / MU
    known = dict.fromkeys(range(int((times < 1.15).sum())), before)
    for factor, verdict in ((1.001, "feasible"), (0.999, "infeasible")):
        rate = SynergyRate(frozen([factor * (after - before) * COMPLIANCE / 0.1]))
        outcome = asked(times, weight, ("effort",), rate, pinned(21, known))
        assert outcome.verdict == verdict
        if isinstance(outcome, Infeasible):
            assert {conflict.key for conflict in outcome.conflicts} == {
                "limits.margin",
                "limits.synergy_rate",
                "limits.pinned",
            }


@pytest.mark.parametrize("intervals", [11, 20])
def test_from_rest_to_rest_the_least_peak_of_acceleration_is_bang_bang(intervals: int) -> None:
    """Rates 0, hA, 2hA, ... and down again cover the way: A = way / (h^2 sum of min(k - 1, K - k))."""
    times, way = np.linspace(0, 2, intervals + 1), 8.0
    known = {0: 2.0, 1: 2.0, intervals - 1: 2.0 + way, intervals: 2.0 + way}
    k = np.arange(1, intervals + 1)
    least = way * COMPLIANCE / ((times[1] ** 2) * np.minimum(k - 1, intervals - k).sum())
    for factor, verdict in ((1.001, "feasible"), (0.999, "infeasible")):
        limit = SynergyAcceleration(frozen([factor * least]))
        outcome = asked(times, 0 * times, ("effort",), limit, pinned(intervals + 1, known), margin=0.0)
        assert outcome.verdict == verdict, factor
        if isinstance(outcome, Infeasible):
            assert {conflict.key for conflict in outcome.conflicts} == {"limits.synergy_acceleration", "limits.pinned"}


def test_least_travel_between_two_squeezes_is_a_straight_line() -> None:
    times = np.sort(np.r_[0.0, 2.0, np.random.default_rng(1).uniform(0, 2, 30)])
    known = {0: 2.0, 12: 9.0, 31: 4.0}
    found = squeeze(asked(times, 0 * times, ("travel",), pinned(32, known), margin=0.0))
    line = np.interp(times, times[list(known)], list(known.values()))
    assert found == pytest.approx(line, rel=1e-5)


def least_bends(times: Array, known: dict[int, float]) -> Array:
    """Return the course of least squared bends through known values, by normal equations."""
    h = np.diff(times)
    span = (h[1:] + h[:-1]) / 2
    D = np.zeros((len(times) - 2, len(times)))
    for k in range(len(D)):
        D[k, k : k + 3] = np.array([1 / h[k], -1 / h[k] - 1 / h[k + 1], 1 / h[k + 1]]) / np.sqrt(span[k])
    fixed = list(known)
    free = [k for k in range(len(times)) if k not in known]
    course = np.zeros(len(times))
    course[fixed] = list(known.values())
    course[free] = -np.linalg.lstsq(D[:, free], D[:, fixed] @ course[fixed], rcond=None)[0]
    return course


@pytest.mark.parametrize("even", [True, False])
def test_the_smoothest_squeeze_solves_the_normal_equations(even: bool) -> None:
    steps = np.ones(40) if even else np.random.default_rng(2).uniform(0.5, 1.5, 40)
    times = 2 * np.r_[0.0, np.cumsum(steps) / steps.sum()]
    known = {0: 3.0, 9: 8.0, 22: 4.0, 23: 4.0, 40: 7.0}
    found = squeeze(asked(times, 0 * times, ("smooth",), pinned(41, known), margin=0.0))
    assert found == pytest.approx(least_bends(times, known), rel=1e-5)


def test_the_smoothest_squeeze_tends_to_the_natural_cubic_spline() -> None:
    nodes, forces = np.array([0.0, 0.6, 1.0, 2.0]), np.array([3.0, 8.0, 4.0, 7.0])
    errors = []
    for intervals in (20, 40, 80):
        times = np.linspace(0, 2, intervals + 1)
        known = {round(node * intervals / 2): force for node, force in zip(nodes, forces, strict=True)}
        found = squeeze(asked(times, 0 * times, ("smooth",), pinned(intervals + 1, known), margin=0.0))
        errors.append(np.abs(found - CubicSpline(nodes, forces, bc_type="natural")(times)).max())
    assert errors[0] < 0.1
    assert errors[1:] == pytest.approx(np.array(errors[:2]) / 4, rel=0.1)  # of second order in the step


def test_from_rest_to_rest_the_smoothest_squeeze_tends_to_the_cubic() -> None:
    """Rest lasts for one interval at each end; the cubic goes from the middle of the one to the middle of the other."""
    for intervals, close in ((20, 3e-2), (80, 2e-3)):
        times = np.linspace(0, 2, intervals + 1)
        known = {0: 2.0, 1: 2.0, intervals - 1: 8.0, intervals: 8.0}
        found = squeeze(asked(times, 0 * times, ("smooth",), pinned(intervals + 1, known), margin=0.0))
        share = np.clip((times - times[1] / 2) / (2 - times[1]), 0, 1)
        assert np.abs(found - (2 + 6 * share**2 * (3 - 2 * share))).max() < close


def test_an_object_is_carried_by_the_squeeze_that_its_softer_side_gives_way_to() -> None:
    """It moves by c n, c = (C_right - C_left) / 2: the least squeeze is ``max(need, (wanted - tolerance) / c)``."""
    tolerance, c = 1.5e-3, (5e-3 - 1e-3) / 2
    times = np.linspace(0, 2, 41)
    wanted = np.zeros((41, 6))
    wanted[:, 0] = 12e-3 * np.sin(np.pi * times / 4) ** 2
    task = TimedTask(
        frozen(times), frozen(np.zeros((41, 6))), Target("motion", frozen(wanted)), MARGIN, (NormalForce(0.0, 50.0),),
        goals("effort"), tolerance=tolerance, tracking="compliant", axes=("x",),
    )  # fmt: skip
    outcome = plan(pinch(MU, compliance=(1e-3, 5e-3)), task)
    force = squeeze(outcome)
    assert force == pytest.approx(np.maximum(MARGIN / MU, (wanted[:, 0] - tolerance) / c), rel=1e-5)
    assert isinstance(outcome, Plan)
    assert outcome.motion.du[:, 0] == pytest.approx(c * force, rel=1e-6)
