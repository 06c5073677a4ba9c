"""Tasks that are refused before any program since one value was altered: the hold, the count, the direction."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from elastic_grasp import motion_at_centroid
from least_changes import rigid_motions
from made_kinds import made_kind
from named_goals import goals
from random_tasks import hand_like_grasp
from small_grasps import pinch, tripod

from synergrip.conic.limits.normal_force import NormalForce
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.tasks.timed_task import Target, TimedTask, still


@dataclass(frozen=True)
class Refused:
    """A task before and after one of its values was altered, and what is to be said of it."""

    before: tuple[Grasp, TimedTask]
    after: tuple[Grasp, TimedTask]
    cause: str
    tolerance: float | None = None  # [m] that would do


def not_held(rng: np.random.Generator) -> Refused:
    """A pinch whose fingers no longer resist a spin about the line that joins them, which the load asks for."""
    compliance = tuple(10 ** rng.uniform(-4, -3, 2))
    grasp = pinch(rng.uniform(0.4, 1.0), rng.uniform(0.004, 0.01), compliance)
    load = np.concatenate([rng.normal(size=3), [2e-3 * rng.normal() + 1e-3], 5e-3 * rng.normal(size=2)])
    rows = [0, 1, 2, 4, 5, 6]
    hard = tuple(replace(each, kind=made_kind("hard", each.friction)) for each in grasp.contacts)
    bare = replace(
        grasp, contacts=hard, G=frozen(grasp.G[:, rows]), J=frozen(grasp.J[rows]),
        C_s=frozen(grasp.C_s[np.ix_(rows, rows)]),
    )  # fmt: skip
    task = _task(np.array([0.0]), load[None], Target("hold", np.zeros((1, 0))))
    assert np.linalg.matrix_rank(bare.G) == 5
    return Refused((grasp, task), (bare, task), "restraint")


def too_many(rng: np.random.Generator) -> Refused:
    """Motions in more directions than a hand has synergies, after some were taken from it."""
    asked = int(rng.integers(2, 6))
    grasp = replace(
        tripod(rng.uniform(0.6, 1.0), rng.uniform(0.0, 0.3)), S=frozen(np.eye(9)), C_z=frozen(np.zeros((9, 9))),
        synergies=tuple(f"z{i}" for i in range(9)),
    )  # fmt: skip
    moves = 1e-3 * rng.normal(size=(asked, 6)) * [1, 1, 1, 20, 20, 20]
    times = np.linspace(0.0, 1.0, asked + 1)
    task = _task(times, _wrench(rng), Target("motion", frozen(np.vstack([np.zeros(6), moves]))))
    kept = int(rng.integers(1, asked))
    S = rng.normal(size=(9, kept))
    few = replace(grasp, S=frozen(S), C_z=frozen(np.zeros((kept, kept))), synergies=tuple(f"z{i}" for i in range(kept)))
    assert np.linalg.matrix_rank(moves) > kept
    return Refused((grasp, task), (few, task), "count")


def elsewhere(rng: np.random.Generator) -> Refused:
    """A motion of the hand's own, and then one that leaves what its synergies can do."""
    while True:
        grasp = hand_like_grasp(rng)
        basis = rigid_motions(grasp)
        if basis.shape[1]:
            break
    to_twist = np.linalg.inv(motion_at_centroid(grasp, np.eye(6)).T)
    scaled = 1e-3 * basis @ rng.normal(size=basis.shape[1])
    outside = rng.normal(size=6)
    outside -= basis @ (basis.T @ outside)
    outside *= 10 ** rng.uniform(-2, 0) * np.linalg.norm(scaled) / np.linalg.norm(outside)
    moves = [np.vstack([np.zeros(6), to_twist @ each]) for each in (scaled, scaled + outside)]
    wrench = grasp.w_0 + _wrench(rng)
    first, second = (_task(np.array([0.0, 1.0]), wrench, Target("motion", frozen(move))) for move in moves)
    return Refused((grasp, first), (grasp, second), "direction", float(np.linalg.norm(outside)))


def _task(times: Array, wrench: Array, target: Target) -> TimedTask:
    wanted = target if target.values.size else still(times)
    return TimedTask(frozen(times), frozen(wrench), wanted, 0.0, (NormalForce(upper=1e3),), goals("effort"))


def _wrench(rng: np.random.Generator) -> Array:
    return np.r_[rng.normal(size=3), 2e-3 * rng.normal(size=3)]


REFUSED = {"restraint": not_held, "count": too_many, "direction": elsewhere}
