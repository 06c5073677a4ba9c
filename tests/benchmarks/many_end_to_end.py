"""Joints in, verdict out: grasps of one hand on random objects a second: ``many_end_to_end.py [COUNT]``.

The Barrett hand around balls of random radius, mass and friction in random postures around "ball", three tips touching;
planned at once for their weight and the largest margin, kinematics, statics, proofs and checks included. First with
places of the balls and normals of the contacts given (`grasps_in_postures`, COUNT of them, 20,000), then each made by
itself (`make_grasp`; the ball is where the tips say), and with fingers that close until they touch (a fortieth of the
COUNT). Prints verified grasps a second of processor time, with two threads of time on the clock, and the shares of the
stages.
"""

from __future__ import annotations

import os
import sys
import time
from importlib.util import find_spec
from typing import Literal

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import numpy as np  # noqa: E402 - after the threads

import synergrip as sg  # noqa: E402

KERNEL: Literal["numba", "numpy"] = "numba" if find_spec("numba") else "numpy"
TIPS = [f"finger{finger}/tip" for finger in (1, 2, 3)]
TASK = sg.Task(
    knots=1, loads=[sg.Gravity((0, 0, -9.81))], goals=[sg.LargestMargin()], linearise="once",
    limits=[sg.SlipMargin(0.1), sg.NormalForce(upper=20.0), sg.JointTorque("hand")],
)  # fmt: skip


def made(hand: sg.Hand, count: int, *, closing: bool) -> tuple[list[sg.Grasp], int]:
    """Return grasps, and how many postures or places were no grasp."""
    rng, grasps, none = np.random.default_rng(0), list[sg.Grasp](), 0
    like = sg.load_problem("barrett-ball-hold").grasp.held
    assert like is not None
    while len(grasps) < count:
        friction, mass = rng.uniform(0.3, 0.9), rng.uniform(0.02, 0.4)
        contacts = [sg.ContactAt(tip, sg.HardFinger(friction=friction), stiffness=8e3) for tip in TIPS]
        place = like.body.position + np.array([0, 0, rng.uniform(-0.03, -0.01)]) if closing else None
        ball = sg.Object(mass=mass, shape=sg.Sphere(radius=rng.uniform(0.03, 0.055)), position=place)
        spread = rng.uniform(0.85, 1.1)
        posture = "open" if closing else np.asarray(like.q) * np.where(np.abs(like.q) > 0, spread, 1.0)
        try:
            close = "close" if closing else None
            grasps.append(
                sg.make_grasp(hand, ball, posture=posture, synergies="motors", contacts=contacts, close=close)
            )
        except sg.InputError:
            none += 1
            if none > 20 * count:
                break
    return grasps, none


def given(hand: sg.Hand, count: int) -> tuple[sg.Grasp, dict[str, np.ndarray], np.ndarray, np.ndarray]:
    """Return a grasp, postures with places and normals as of `grasps_in_postures`, weights and friction factors."""
    few, _ = made(hand, 60, closing=False)
    rng = np.random.default_rng(1)
    which = rng.integers(0, len(few), count)
    held = [each.held for each in few if each.held is not None]
    arrays = {
        "q": np.array([each.q for each in held])[which] + 0.01 * rng.normal(size=(count, few[0].n_q)),
        "positions": np.array([each.body.position for each in held])[which],
        "normals": np.array([[contact.normal for contact in each.contacts] for each in few])[which],
    }
    weights = np.zeros((count, 6))
    weights[:, 2] = -9.81 * rng.uniform(0.02, 0.4, count)
    return few[0], arrays, weights, rng.uniform(0.3, 0.9, count) / few[0].contacts[0].friction


def told_of_given(hand: sg.Hand, count: int) -> None:
    """Print the figures of grasps whose contacts are given."""
    grasp, arrays, weights, friction = given(hand, count)
    for threads, clock, name in ((1, time.process_time, "processor time"), (2, time.perf_counter, "two threads")):
        start = clock()
        stack = sg.grasps_in_postures(grasp, **arrays)
        between = clock()
        many = sg.plan_many(
            stack, TASK, wrenches=weights, friction_factors=friction, kernel=KERNEL, threads=threads
        )  # fmt: skip
        end = clock()
        print(f"contacts given, {name}: {many.verified.sum() / (end - start):,.0f} verified grasps a second; "
              f"{(between - start) / (end - start):.0%} of the time for kinematics; {many}", flush=True)  # fmt: skip


def told(name: str, hand: sg.Hand, count: int, *, closing: bool) -> None:
    """Print the figures of one way to make grasps."""
    start = time.process_time()
    grasps, none = made(hand, count, closing=closing)
    if not grasps:
        print(f"{name}: no grasp in {none} postures")
        return
    between = time.process_time()
    many = sg.plan_many(grasps, TASK, kernel=KERNEL)
    end = time.process_time()
    verified, share = int(many.verified.sum()), (between - start) / (end - start)
    print(f"{name}: {verified / (end - start):,.0f} verified grasps a second; {share:.0%} of the time from joints to "
          f"contacts ({none} of {none + len(grasps)} were no grasp); from there {verified / (end - between):,.0f} a "
          f"second; {many}")  # fmt: skip


def main() -> None:
    """Print all."""
    count, hand = int(sys.argv[1]) if len(sys.argv) > 1 else 20000, sg.load_hand("barrett")
    few, _ = made(hand, 2, closing=False)
    sg.plan_many(few, TASK, kernel=KERNEL)  # loaded before anything is measured
    told_of_given(hand, count)
    told("made one by one", hand, count // 40, closing=False)
    told("with closing", hand, count // 40, closing=True)


if __name__ == "__main__":
    main()
