"""Plans of trajectories judged at and between their knots by statics, limits and goals written down anew.

    python tests/judged_trajectories.py [COUNT [FEWEST MOST]]

judges COUNT (200) random trajectories of FEWEST to MOST (50 to 200) knots and prints what is wrong, and figures.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from elastic_grasp import AXES, Course, course, motion_at_centroid, normal_forces, sizes_on, slip_margins
from made_kinds import made_kind, spin_of
from random_trajectories import random_trajectory

from synergrip.errors import SelfCheckError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, interpolated
from synergrip.planning.outcome import Infeasible, Plan, Unknown
from synergrip.planning.planning import plan
from synergrip.statics.motion import Motion, forward

BETWEEN = 20
"""Instants looked at from each knot to the next."""
EXACT = 1e-9
HOLDS = 1e-6


@dataclass
class Judged:
    """What became of one trajectory."""

    seed: int
    verdict: str
    wrong: list[str]
    notes: tuple[str, ...] = ()
    round_trip: float = 0.0
    """Largest relative difference between the plan's motion and the statics."""
    excess: float = -np.inf
    """Largest excess over a limit at a knot, as a share of it; `between` everywhere."""
    between: float = -np.inf
    seconds: float = 0.0


def judged(seed: int, knots: int) -> Judged:
    """Plan a random trajectory and judge the answer."""
    grasp, task = random_trajectory(seed, knots)
    start = time.process_time()
    try:
        outcome = plan(grasp, task)
    except SelfCheckError as error:
        return Judged(seed, "self-check", [str(error)])
    seconds = time.process_time() - start
    if isinstance(outcome, Unknown):
        return Judged(seed, "unknown", [outcome.why], seconds=seconds)
    if isinstance(outcome, Infeasible):
        return Judged(seed, "infeasible", _proof(outcome), seconds=seconds)
    found = course(grasp, task.times, outcome.motion.dz_r, task.wrench)
    at_knots, between = excesses(outcome, found), excesses(outcome, _dense(outcome))
    trip, balance = _round_trip(outcome.motion, found), _imbalance(outcome, found)
    wrong = [f"round trip {trip:.1e}"] * (trip > EXACT) + [f"balance {balance:.1e}"] * (balance > EXACT)
    wrong += [f"{key} by {value:.1e}" for key, value in at_knots.items() if value > HOLDS]
    wrong += [f"{key} between knots by {value:.1e}" for key, value in between.items() if value > HOLDS]
    worst = max(at_knots.values()), max(between.values())
    return Judged(seed, "feasible", wrong, outcome.notes, trip, *worst, seconds)


def _dense(outcome: Plan) -> Course:
    """Return what references and loads do that are linear between the knots, by the planner's own forward maps."""
    times = outcome.task.times
    many = np.unique(np.concatenate([np.linspace(a, b, BETWEEN + 1) for a, b in pairwise(times)]))
    dz_r, wrench = (interpolated(many, times, v) for v in (outcome.motion.dz_r, outcome.task.wrench))
    motion = forward(outcome.analysis.response, many, dz_r, wrench)
    return Course(many, dz_r, wrench, motion.forces, motion.torques, motion.efforts, motion.du, motion.sag, motion.dq,
                  motion.dz)  # fmt: skip


def _round_trip(motion: Motion, found: Course) -> float:
    """Return the largest difference in anything that a motion holds, relative to its size."""
    errors = []
    for name in ("forces", "torques", "efforts", "du", "sag", "dq", "dz"):
        one, other = getattr(motion, name), getattr(found, name)
        size = float(np.abs(other).max(initial=0.0))
        errors.append(float(np.abs(one - other).max(initial=0.0)) / size if size > 1e-12 else 0.0)
    return max(errors)


def _imbalance(outcome: Plan, found: Course) -> float:
    grasp = outcome.analysis.grasp
    return float(np.abs(outcome.motion.forces @ grasp.G.T + found.wrench).max()) / float(np.abs(found.forces).max())


def excesses(outcome: Plan, found: Course) -> dict[str, float]:
    """Return by key how far the worst instant is beyond each limit, as a share of the limit; below 0 inside.

    Accelerations are those of the knots; between them references are lines.
    """
    grasp, task, unit = outcome.analysis.grasp, outcome.task, outcome.formulation.force_unit
    rates = np.diff(found.dz_r, axis=0) / np.diff(found.times)[:, None]
    h = np.diff(task.times)[:, None]
    bends = 2 * np.diff(np.diff(outcome.motion.dz_r, axis=0) / h, axis=0) / (h[1:] + h[:-1])
    values = {
        "limits.joint_torque": found.torques, "limits.actuator_effort": found.efforts,
        "limits.synergy_reference": found.dz_r, "limits.synergy_rate": rates, "limits.synergy_acceleration": bends,
    }  # fmt: skip
    normal, rigid = normal_forces(grasp, found.forces), _rigid_part(outcome, found)
    wanted = interpolated(found.times, task.times, _wanted(outcome))
    result = {"limits.margin": float((task.margin - slip_margins(grasp, found.forces)).max()) / unit}
    for limit in task.limits:
        key, worst = limit.key, np.inf
        if key in values:
            worst = np.max(np.abs(values[key]) / limit.limit) - 1
        elif key == "limits.normal_force":
            worst = max(normal.max() - limit.upper, limit.lower - normal.min()) / unit
        elif key == "limits.safety_factor":
            worst = -slip_margins(_slippery(grasp, limit.ratios), found.forces).min() / unit
        elif key == "limits.joint_range":
            q, half = limit.start + found.dq, (limit.upper - limit.lower) / 2
            worst = np.max(np.maximum(q - limit.upper, limit.lower - q) / half)
        elif key == "limits.elastic_motion":
            beyond = motion_at_centroid(grasp, found.du - found.sag - rigid)
            worst = np.linalg.norm(beyond, axis=1).max() / limit.limit - 1
        elif key == "limits.drift":
            worst = sizes_on(grasp, AXES, found.du - wanted).max() / limit.limit - 1
        result[key] = float(worst)
    return result | _tracking(outcome, found, rigid, wanted)


def _slippery(grasp: Grasp, ratios: Array) -> Grasp:
    """Return the grasp with less friction: mu and nu times a ratio for each contact."""
    pairs = zip(grasp.contacts, ratios, strict=True)
    less = (replace(c, kind=made_kind(c.kind.name, r * c.friction, r * spin_of(c))) for c, r in pairs)
    return replace(grasp, contacts=tuple(less))


def _tracking(outcome: Plan, found: Course, rigid: Array, target: Array) -> dict[str, float]:
    """Return how far the motion is from the target one beyond what is tolerated, as a share of that."""
    grasp, task = outcome.analysis.grasp, outcome.task
    compliant = task.tracking == "compliant"
    reached = found.du if compliant else rigid
    rounding = 1e-6 * float(np.linalg.norm(target, axis=1).max()) + 1e-12
    tolerance = task.tolerance if compliant else max(task.tolerance, rounding)
    result = {"task.tolerance": float(sizes_on(grasp, task.axes, reached - target).max()) / tolerance - 1}
    rest = tuple(axis for axis in AXES if axis not in task.axes)
    if rest and task.drift is not None:
        result["task.drift"] = float(sizes_on(grasp, rest, reached - target).max()) / task.drift - 1
    return result


def _rigid_part(outcome: Plan, found: Course) -> Array:
    """Return the part of the references' motion (T, 6) in Gamma_ucs, the nearest to it at the centroid."""
    grasp, basis = outcome.analysis.grasp, outcome.analysis.spaces.Gamma_ucs
    seen, moved = motion_at_centroid(grasp, basis.T).T, motion_at_centroid(grasp, found.du - found.sag).T
    return np.asarray((basis @ np.linalg.lstsq(seen, moved, rcond=None)[0]).T)


def _wanted(outcome: Plan) -> Array:
    """Return where the object is wanted (T, 6): where it starts, on the axes that are not asked for."""
    task, basis = outcome.task, outcome.analysis.spaces.Gamma_ucs
    values = task.target.values
    whole = values if task.target.kind == "motion" else values @ basis[:, : values.shape[1]].T
    return whole * np.isin(AXES, task.axes)


def _proof(outcome: Infeasible) -> list[str]:
    """Return what is wrong with a proof: y in the dual cones and ``b'y + |A'y|' box < 0`` leave no plan."""
    if outcome.stage != "magnitude":
        return [] if outcome.certificate.verified else [f"{outcome.stage} not verified"]
    y, program = outcome.certificate.y, outcome.program
    if y is None or program is None:
        return ["no proof"]
    wrong = []
    for block, rows in program.slices():
        part = y[rows].reshape(-1, block.dim)
        if block.kind.value == "nonnegative":
            wrong += [f"{block.limit} pulls"] * bool(part.min(initial=0) < 0)
        if block.kind.value == "second-order":
            outside = np.linalg.norm(part[:, 1:], axis=1) - part[:, 0]
            wrong += [f"{block.limit} leaves its cone"] * bool(outside.max() > 1e-15 * np.abs(y).max())
    drop = float(program.b @ y + np.abs(program.A.T @ y) @ program.variable_bounds)
    wrong += [f"proves nothing: {drop:.1e}"] * (not drop < 0)
    known = {"friction cone", "limits.margin", "task.tolerance", "task.drift"}
    stated = {*known, *(limit.key for limit in outcome.task.limits)}
    return wrong + [f"{each.key} conflicts unstated" for each in outcome.conflicts if each.key not in stated]


def main() -> None:
    """Judge many trajectories and print figures."""
    count, fewest, most = (int(text) for text in (*sys.argv[1:], *("200", "50", "200")[len(sys.argv) - 1 :]))
    knots = np.random.default_rng(0).integers(fewest, most + 1, count)
    found = []
    for seed in range(count):
        found.append(judged(seed, int(knots[seed])))
        each = found[-1]
        for line in (*each.wrong, *(note for note in each.notes if "not verified" in note)):
            print(f"seed {seed}, {knots[seed]} knots, {each.verdict}: {line}", flush=True)
    plans = [each for each in found if each.verdict == "feasible"]
    print(", ".join(f"{verdict} {times}" for verdict, times in Counter(each.verdict for each in found).most_common()))
    trip, knot, anywhere = (max(getattr(each, name) for each in plans) for name in ("round_trip", "excess", "between"))
    print(f"largest relative difference of the motion {trip:.1e}")
    print(f"largest excess at a knot {knot:.1e}, anywhere {anywhere:.1e}")
    seconds = [each.seconds for each in found]
    print(f"seconds: median {np.median(seconds):.2f}, most {max(seconds):.2f}")


if __name__ == "__main__":
    main()
