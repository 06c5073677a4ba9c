"""Two jaws on slides of their own, as a URDF file and a plan.json: what they do is known in closed form."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

JOINTS = ("left_y", "left_x", "right_y", "right_x")
"""Across, and toward the object. The right jaw is the left one turned by 180 degrees about z."""


def _slide(name: str, parent: str, child: str, axis: str, yaw: float = 0.0) -> str:
    return (
        f'<joint name="{name}" type="prismatic"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="0 0 0" rpy="0 0 {yaw!r}"/><axis xyz="{axis}"/></joint>'
    )


def written(folder: Path) -> Path:
    """Write the URDF file of the jaws."""
    links = ["palm", *(f"{side}_{part}" for side in ("left", "right") for part in ("carriage", "jaw"))]
    joints = []
    for side, yaw in (("left", 0.0), ("right", np.pi)):
        joints += [
            _slide(f"{side}_y", "palm", f"{side}_carriage", "0 1 0", yaw),
            _slide(f"{side}_x", f"{side}_carriage", f"{side}_jaw", "1 0 0"),
        ]
    text = "".join(f'<link name="{link}"/>' for link in links) + "".join(joints)
    path = folder / "jaws.urdf"
    path.write_text(f'<robot name="jaws">{text}</robot>', encoding="utf-8")
    return path


def document(
    path: Path, shape: dict[str, Any], half: float, radius: float, compliance: list[float], C_q: list[float]
) -> dict[str, Any]:
    """Return the plan.json of jaws that touch an object of half a width at x = -half and half, all at rest.

    Every joint is a synergy. The contacts are soft ones with `compliance` along n, t, o and about n.
    """
    turn = np.diag([-1.0, -1.0, 1.0])
    contacts = []
    for side, R in (("left", np.eye(3)), ("right", turn)):
        contacts.append({
            "name": side, "link": f"{side}_jaw", "point_m": (R @ [-half, 0, 0]).tolist(), "frame": R.T.tolist(),
            "kind": "soft", "parameters": {"friction": 0.5, "spin_friction_m": 0.01},
            "compliance": np.diag(compliance).tolist(), "pad_radius_m": radius,
            "pad_centre_m": [-half - radius, 0.0, 0.0],
        })  # fmt: skip
    return {
        "time_s": [0.0], "dz_r": [[0.0] * 4], "wrench": [[0.0] * 6],
        "execution": {
            "hand_file": path.name, "root_link": "palm", "joints": list(JOINTS), "q_0": [0.0] * 4,
            "S": np.eye(4).tolist(), "C_q": np.diag(C_q).tolist(), "C_z": np.zeros((4, 4)).tolist(),
            "lambda_0": [0.0] * 8, "tau_0": [0.0] * 4, "contacts": contacts,
            "object": {"position_m": [0.0, 0.0, 0.0], "mass_kg": None, "inertia_kg_m2": None, "shape": shape},
            "load": {"times_s": [0.0], "wrench": [[0.0] * 6], "axes": "palm", "point": [0, 0, 0], "curved_s": []},
        },
    }  # fmt: skip


def cube(half: float) -> dict[str, Any]:
    """Return the shape of a cube."""
    return {"box": {"size_m": [2 * half] * 3, "rotation": np.eye(3).tolist()}}
