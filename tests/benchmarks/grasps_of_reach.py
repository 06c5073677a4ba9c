"""Grasps from which hands take an object far: a ball between the tips of the thumb and of two fingers.

Posture, place and radius are those from which the tips of the three fingers, as points that stick to the ball, get to
most of the motions of `in_grasp.py`: drawn at random from the ranges of the joints, and moved on as long as that gains
something. Fewer fingers have more room in common than four or five, a small ball less way to go when it turns. Every
joint of the three fingers is driven by itself: with three contacts that stick that is all six rigid motions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib.metadata import files
from itertools import chain
from typing import Any

import synergrip as sg
from synergrip.problems.problem import Problem

FINGERS = ("thumb", "index", "middle")
Posture = Sequence[Sequence[float]]
"""[deg] Joint values of each finger, from the palm outward."""


def dlr() -> Problem:
    """Return a ball of 20 mm radius in the DLR Hand II; the ring finger stays away."""
    values = ((34.16, 5.98, 34.25), (32.68, -10.74, 49.98), (30.11, -8.57, 50.57))
    names = [[f"{finger}_{joint}" for joint in ("proximal", "abduction", "medial")] for finger in FINGERS]
    hand = {"model": "dlr-hand-ii", "synergies": "actuators", "posture": _posture(names, values)}
    return _held(hand, {"at": _tips(), "stiffness": "8 N/mm"}, (-118.51, 181.24, 39.90), 20.0, (9.81, 0, 0))


def allegro() -> Problem:
    """Return a ball of 30 mm radius in the Allegro hand of example-robot-data."""
    (model,) = (file for file in files("example-robot-data") or () if file.name == "allegro_right_hand.urdf")
    values = ((53.01, 33.5, 35.45, 84.27), (3.97, 30.97, 40.89, 68.42), (4.3, 17.49, 79.15, 11.25))
    first = (12, 0, 4)
    names = [[f"joint_{joint}.0" for joint in range(begin, begin + 4)] for begin in first]
    hand = {
        "model": str(model.locate()), "synergies": "all", "compliance": {"joint": "0.02 rad/(N m)"},
        "posture": _posture(names, values),
    }  # fmt: skip
    tips = [{"link": f"link_{joint + 3}.0_tip", "point": ["0 mm"] * 3, "radius": "12 mm"} for joint in first]
    return _held(hand, {"stiffness": "6 N/mm"}, (66.82, 27.66, 22.32), 30.0, (0, 0, -9.81), tips)


def human() -> Problem:
    """Return a ball of 36 mm radius in the human hand, between thumb, middle and ring finger.

    Its thumb is short (25, 15 and 10 mm): its tip alone, from the best place that there is and without any turn,
    follows about 29 of the 100 motions.
    """
    fingers = ("thumb", "middle", "ring")
    values = ((8.8, 40.15, -9.83, 11.56), (2.4, -12.74, 27.19, 24.92), (-1.41, -7.78, 20.17, 50.22))
    joints = ("mcp_abd", "mcp_flex", "pip", "dip")
    names = [[f"thumb_{joint}" for joint in ("tmc_abd", "tmc_flex", "mcp", "ip")]]
    names += [[f"{finger}_{joint}" for joint in joints] for finger in fingers[1:]]
    hand = {"model": "human", "synergies": "all", "posture": _posture(names, values)}
    return _held(hand, {"at": _tips(fingers), "stiffness": "8 N/mm"}, (-22.28, 116.8, -10.23), 36.0, (0, 0, -9.81))


GRASPS: dict[str, Callable[[], Problem]] = {"dlr": dlr, "human": human, "allegro": allegro}


def _tips(fingers: Sequence[str] = FINGERS) -> list[str]:
    return [f"{finger}/tip" for finger in fingers]


def _posture(names: Sequence[Sequence[str]], values: Posture) -> dict[str, str]:
    each = zip(chain.from_iterable(names), chain.from_iterable(values), strict=True)
    return {name: f"{value} deg" for name, value in each}


def _held(
    hand: dict[str, Any], contacts: dict[str, Any], place: Sequence[float], radius: float, gravity: Sequence[float],
    tips: Sequence[dict[str, Any]] = (),
) -> Problem:  # fmt: skip
    """Return a problem that holds a ball of 50 g: where [mm], how large [mm], under which gravity, with which tips."""
    return sg.load_problem({
        "schema": 1,
        "hand": hand,
        "object": {
            "shape": {"sphere": {"radius": f"{radius} mm"}}, "mass": "50 g", "position": [f"{x} mm" for x in place],
        },
        "contacts": {"model": "hard", "friction": 0.8, **contacts},
        **({"contact": list(tips)} if tips else {}),
        "task": {"gravity": list(gravity)},
        "limits": {"margin": "0.2 N", "normal_force": "20 N", "joint_torque": "hand"},
    })  # fmt: skip
