"""The fastest timing along random paths, judged by a nonlinear optimiser of its own.

    python tests/judged_timing.py 100 [first seed]

Random paths of a palm that carries a ball in the Barrett hand, at random caps on the normal forces. The optimiser
(SciPy's SLSQP) knows the poses on a coarse grid, differentiates them itself, and has its own maps from load to forces;
its unknowns are speeds and squeezes, its aim the time, and it begins with a slow timing. On its grid it must not be
faster than the program. On the grid of the product the cones are looked at in between, by the same maps. Counts the
paths, those that have no timing, how near the optimiser comes, and what is wrong.
"""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

sys.path.insert(0, str(Path(__file__).parent))

import synergrip as sg
from synergrip.grasps.scale import scale_of
from synergrip.linalg import Array
from synergrip.margin.timing import fastest_program
from synergrip.margin.timing.by_length import Leg, legs
from synergrip.margin.timing.fastest_program import Timing, fastest
from synergrip.margin.timing.question import timing_question

COARSE, FINE = 14, 128
STEP = 2e-6
"""[m] By which poses are differentiated: short, as third derivatives jump at the poses of a path."""
NONE_FASTER, NEAR = 1e-4, 1e-2
"""Share of the time by which the optimiser may be faster, for its own tolerance; and within which it counts as near."""
BESIDE = 1e-3
"""Share of a part from its ends on where forces are looked at: differences across a pose, at which third derivatives
jump, are those of neither side."""
SLIPS = 2e-4
"""[N] By which a margin may be missed between the points."""


@dataclass(frozen=True)
class Statics:
    """The same grasp, by textbook formulas."""

    G_plus: Array
    E: Array
    friction: float
    mass: float
    tensor: Array
    centre: Array
    gravity: Array

    @classmethod
    def of(cls, grasp: sg.Grasp, gravity: Array) -> Statics:
        """K = (C_s + J C_q J' + J S C_z S' J')^-1, G+ = K G' (G K G')^-1, E spans (I - G+ G) K J S."""
        G, JS = grasp.G, grasp.J @ grasp.S
        K = np.linalg.inv(grasp.C_s + grasp.J @ grasp.C_q @ grasp.J.T + JS @ grasp.C_z @ JS.T)
        G_plus = K @ G.T @ np.linalg.inv(G @ K @ G.T)
        u, sizes, _ = np.linalg.svd((np.eye(len(K)) - G_plus @ G) @ K @ JS)
        assert grasp.held is not None
        body = grasp.held.body
        assert body.shape is not None
        E = u[:, : int((sizes > 1e-8 * sizes[0]).sum())]
        tensor = body.mass * np.asarray(body.shape.inertia)
        return cls(G_plus, E, grasp.contacts[0].friction, body.mass, tensor, np.array(body.position), gravity)

    def loads(self, leg: Leg, at: Array) -> tuple[Array, Array, Array]:
        """Weight (T, 6), and what acceleration and squared speed along the path add, by differences of poses."""
        first = Rotation.from_quat(leg.palm.poses(np.zeros(1))[0, 3:])
        poses = [leg.palm.poses(at + k * STEP) for k in (-1, 0, 1)]
        turned = [Rotation.from_quat(each[:, 3:]) for each in poses]
        centres = [each[:, :3] + R.apply(self.centre) for each, R in zip(poses, turned, strict=True)]
        back, R, on = turned
        tangent, bend = (centres[2] - centres[0]) / (2 * STEP), (centres[2] - 2 * centres[1] + centres[0]) / STEP**2
        omega = (back.inv() * on).as_rotvec() / (2 * STEP)
        rates = [(R.inv() * on).as_rotvec() / STEP, (back.inv() * R).as_rotvec() / STEP]
        alpha = (rates[0] - rates[1]) / STEP
        down = (R.inv() * first).apply(self.gravity)
        moment = alpha @ self.tensor + np.cross(omega, omega @ self.tensor)
        of_a = np.hstack([-self.mass * R.inv().apply(tangent), -omega @ self.tensor])
        of_b = np.hstack([-self.mass * R.inv().apply(bend), -moment])
        return np.hstack([self.mass * down, np.zeros((len(at), 3))]), of_a, of_b

    def rooms(self, forces: Array, margin: float, cap: float) -> Array:
        """Room in cones and under the cap (T, 6) of forces (T, 9)."""
        n, t, o = forces[:, 0::3], forces[:, 1::3], forces[:, 2::3]
        return np.hstack([self.friction * n - np.sqrt(t**2 + o**2 + 1e-16) - margin, cap - n])

    def slopes(self, forces: Array) -> Array:
        """Derivative of the rooms (T, 6, 9)."""
        found, count = np.zeros((len(forces), 6, 9)), np.arange(3)
        n, t, o = 3 * count, 3 * count + 1, 3 * count + 2
        size = np.sqrt(forces[:, t] ** 2 + forces[:, o] ** 2 + 1e-16)
        found[:, count, n], found[:, 3 + count, n] = self.friction, -1.0
        found[:, count, t], found[:, count, o] = -forces[:, t] / size, -forces[:, o] / size
        return found


def optimised(statics: Statics, leg: Leg, margin: float, cap: float, start: Timing) -> float:
    """The shortest time that SLSQP finds on the grid of a leg [s]; infinite when it ends outside of the limits."""
    n, k, h = len(leg.at) - 1, statics.E.shape[1], np.diff(leg.at)
    part, side = np.divmod(np.arange(2 * n), 2)
    at_rest, of_a, of_b = statics.loads(leg, leg.at[part + side])
    unit, size = float(start.b.max()), cap
    to_b = np.zeros((n + 1, n - 1))
    to_b[1:-1] = unit * np.eye(n - 1)
    slope = (to_b[part + 1] - to_b[part]) / (2 * h[part])[:, None]
    of_speeds = of_a[:, :, None] * slope[:, None, :] + of_b[:, :, None] * to_b[part + side][:, None, :]
    jacobian = np.zeros((2 * n, 9, n - 1 + (n + 1) * k))
    jacobian[:, :, : n - 1] = -np.einsum("ij,tjk->tik", statics.G_plus, of_speeds)
    for i, point in enumerate(part + side):
        jacobian[i, :, n - 1 + point * k : n - 1 + (point + 1) * k] = size * statics.E
    known = -at_rest @ statics.G_plus.T

    def forces(x: Array) -> Array:
        return known + jacobian @ x

    def time(x: Array) -> tuple[float, Array]:
        speeds = np.sqrt(np.maximum(to_b @ x[: n - 1], 0.0))
        total = speeds[:-1] + speeds[1:]
        by_speed = -2 * h / total**2
        inner = (by_speed[:-1] + by_speed[1:]) * unit / (2 * np.maximum(speeds[1:-1], 1e-12))
        whole = float(start.seconds)
        return float((2 * h / total).sum()) / whole, np.concatenate([inner, np.zeros((n + 1) * k)]) / whole

    rng, best = np.random.default_rng(len(leg.at)), np.inf
    squeeze = np.linalg.lstsq(statics.E, np.tile([0.6 * cap, 0.0, 0.0], 3), rcond=None)[0] / size
    for slow in (0.02, 0.1):
        first = np.concatenate([slow * rng.uniform(0.8, 1.2, n - 1), np.tile(squeeze, n + 1)])
        found: Any = minimize(  # type: ignore[call-overload]
            time, first, jac=True, method="SLSQP", bounds=[(1e-6, None)] * (n - 1) + [(None, None)] * ((n + 1) * k),
            constraints={
                "type": "ineq", "fun": lambda x: statics.rooms(forces(x), margin, cap).ravel() / cap,
                "jac": lambda x: (statics.slopes(forces(x)) @ jacobian).reshape(-1, len(x)) / cap,
            }, options={"maxiter": 300, "ftol": 1e-9},
        )  # fmt: skip
        if statics.rooms(forces(found.x), margin, cap).min() > -1e-6 * cap:
            best = min(best, found.fun * start.seconds)
    return best


def random_path(rng: np.random.Generator) -> sg.PalmPath:
    """Return poses on a path of some waves, with turns of up to some 60 degrees."""
    times = np.linspace(0.0, 1.0, 33)
    waves = np.sin(np.outer(times, rng.uniform(0.5, 4.0, 6)) + rng.uniform(0, 6, 6))
    return sg.PalmPath(times, waves * np.array([*rng.uniform(0.03, 0.3, 3), *rng.uniform(0.0, 0.6, 3)]), inertia=True)


def timing(grasp: sg.Grasp, task: sg.Task, parts: int, held: float) -> Timing | str:
    """Return what the product says of the linear model, on a grid of so many parts, and looked at in between or not."""
    fastest_program.HELD = held
    timed, palm = task.timed(grasp), task.loads[1]
    assert isinstance(palm, sg.PalmPath)
    path = legs(palm, 0.0, 1.0, scale_of(grasp).length, parts)
    speed = sum(leg.length for leg in path)
    return fastest(lambda usual: timing_question(grasp, task, timed, path, usual), (4 * speed, speed**2), ())


def missed(statics: Statics, found: Timing, margin: float, cap: float) -> float:
    """How far cones or cap are missed anywhere, at 14 instants of every part [N]."""
    question, worst, first = found.question, np.inf, 0
    alpha = found.v @ question.formulation.alpha.matrix.T @ question.formulation.spaces.E_s.T
    for leg in question.legs:
        own = slice(first, first + len(leg.at))
        b, squeeze, h = found.b[own], alpha[own], np.diff(leg.at)
        for share in np.linspace(BESIDE, 1.0 - BESIDE, 14):
            rest, of_a, of_b = statics.loads(leg, leg.at[:-1] + share * h)
            a, square = np.diff(b) / (2 * h), (1 - share) * b[:-1] + share * b[1:]
            wrench = rest + of_a * a[:, None] + of_b * square[:, None]
            forces = (1 - share) * squeeze[:-1] + share * squeeze[1:] - wrench @ statics.G_plus.T
            worst = min(worst, float(statics.rooms(forces, margin, cap).min()))
        first += len(leg.at) - 1
    return -worst


def main(count: int, first: int) -> None:
    """Print what came of many paths."""
    problem, counted, ratios = sg.load_problem("barrett-ball-carry"), Counter[str](), list[float]()
    gravity = np.array([0.0, 0.0, -9.81])
    statics = Statics.of(problem.grasp, gravity)
    for seed in range(first, first + count):
        rng = np.random.default_rng([31, seed])
        cap, margin = float(rng.uniform(10, 30)), float(rng.uniform(0, 0.5))
        limits = [sg.SlipMargin(margin), sg.NormalForce(upper=cap), sg.JointRange(lower=-np.inf, upper=np.inf)]
        task = sg.Task(loads=[sg.Gravity(tuple(gravity)), random_path(rng)], limits=limits)
        coarse, fine = timing(problem.grasp, task, COARSE, np.inf), timing(problem.grasp, task, FINE, 1e-6)
        counted["paths"] += 1
        if isinstance(coarse, str) or isinstance(fine, str) or len(coarse.question.legs) > 1:
            counted["without"] += 1
            print(f"seed {seed}: {coarse if isinstance(coarse, str) else fine}", flush=True)
            continue
        assert coarse.least is not None
        other = optimised(statics, coarse.question.legs[0], margin, cap, coarse)
        ratios.append(other / coarse.least)
        counted["near"] += ratios[-1] < 1 + NEAR
        if other < coarse.least * (1 - NONE_FASTER):
            counted["wrong"] += 1
            print(f"seed {seed}: the optimiser takes {other:.6g} s, said are {coarse.least:.6g} s at least", flush=True)
        if (short := missed(statics, fine, margin, cap)) > SLIPS:
            counted["wrong"] += 1
            print(f"seed {seed}: cones or cap are missed by {short:.2g} N between the points", flush=True)
    print(", ".join(f"{name} {counted[name]}" for name in ("paths", "without", "near", "wrong")))
    print(f"optimiser over least: {', '.join(f'{x:.6f}' for x in np.quantile(ratios, [0, 0.5, 1]))}")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
