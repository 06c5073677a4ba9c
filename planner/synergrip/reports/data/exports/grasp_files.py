"""The grasp that a plan holds, for programs that pick: isaac_grasp YAML, and the fields of moveit_msgs/Grasp."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.grasps.contacts.kind import is_moment
from synergrip.linalg import Array
from synergrip.planning.arrays import one_line
from synergrip.reports.data.exports.exported_plan import ExportedPlan, HandStates
from synergrip.reports.data.exports.joint_trajectories import empty_trajectory, header, trajectory_message
from synergrip.reports.data.exports.quantities import QUATERNION
from synergrip.reports.data.exports.yaml_text import write_yaml
from synergrip.vectors import quaternions

OBJECT = "object"
"""What the frame of the object is called: its origin, axes as those of the palm at the start."""
FRAMES = (
    "position and orientation: of the palm in the frame of the object, m and quaternion",
    "the frame of the object: its origin as the plan has it, and the axes that the palm has at the start",
)


def write_isaac_grasp(plan: ExportedPlan, path: Path) -> None:
    """Write the grasp at the first knot, and at the last, as isaac_grasp 1.0."""
    hand = _hand(plan)
    knots = {"first_knot": 0, "last_knot": len(plan.times) - 1}
    grasps = {name: _isaac(plan, hand, knot) for name, knot in knots.items() if knot or name == "first_knot"}
    document = {
        "format": "isaac_grasp", "format_version": 1.0,
        **dict.fromkeys(("object_frame", "object_frame_link"), OBJECT),  # two names are in use for each frame
        **dict.fromkeys(("gripper_frame", "gripper_frame_link"), _palm(hand)), "grasps": grasps,
    }  # fmt: skip
    units = "cspace_position: rad, m of joints that slide. Empty is what the plan does not know"
    write_yaml(path, plan, ("isaac_grasp 1.0", *FRAMES, units), document)


def write_moveit_grasp(plan: ExportedPlan, path: Path) -> None:
    """Write the grasp at the first knot by the names of the fields of moveit_msgs/Grasp."""
    hand = _hand(plan)
    place, turned = _palm_in_object(hand, 0)
    w, x, y, z = turned.tolist()
    document = {
        "id": plan.title,
        "pre_grasp_posture": empty_trajectory(),
        "grasp_posture": trajectory_message(plan.joints, hand.q[0], plan.torques[0]),
        "grasp_pose": {
            "header": header(OBJECT),
            "pose": {
                "position": dict(zip("xyz", place.tolist(), strict=True)),
                "orientation": {"x": x, "y": y, "z": z, "w": w},
            },
        },
        "grasp_quality": 0.0,
        **{key: _nowhere() for key in ("pre_grasp_approach", "post_grasp_retreat", "post_place_retreat")},
        "max_contact_force": largest_force(plan),
        "allowed_touch_objects": [],
    }
    units = (
        "grasp_posture: rad and N m (m and N of joints that slide) at the first knot",
        "max_contact_force: N, the largest of any contact at any knot",
        "grasp_quality 0 and what is empty say nothing",
    )
    write_yaml(path, plan, ("moveit_msgs/msg/Grasp, by the names of its fields", *FRAMES, *units), document)


def largest_force(plan: ExportedPlan) -> float:
    """Return the largest contact force [N] at the knots, moments left out."""
    rows = np.cumsum([0, *map(len, plan.components)])
    largest = 0.0
    for (start, end), components in zip(pairwise(rows), plan.components, strict=True):
        force = plan.forces[:, start:end][:, [not is_moment(component) for component in components]]
        largest = max(largest, float(np.linalg.norm(force, axis=1).max()))
    return largest


def _hand(plan: ExportedPlan) -> HandStates:
    assert plan.hand is not None  # such formats are refused before
    return plan.hand


def _palm(hand: HandStates) -> str:
    return one_line(hand.told.text("root_link"))


def _palm_in_object(hand: HandStates, knot: int) -> tuple[Array, Array]:
    """Return where the palm is in the frame of the object: position (3,) [m] and quaternion (4,), w first."""
    turned = hand.rotation[knot].T
    return -turned @ hand.position[knot], quaternions(turned[None])[0]


def _isaac(plan: ExportedPlan, hand: HandStates, knot: int) -> dict[str, Any]:
    place, turned = _palm_in_object(hand, knot)
    w, *xyz = turned.tolist()
    return {
        "confidence": None, "position": place.tolist(), "orientation": {QUATERNION[0]: w, "xyz": xyz},
        "cspace_position": dict(zip(plan.joints, hand.q[knot].tolist(), strict=True)),
        "pregrasp_cspace_position": {},
    }  # fmt: skip


def _nowhere() -> dict[str, Any]:
    """Return a moveit_msgs/GripperTranslation that says nothing."""
    vector = {"header": header(), "vector": dict.fromkeys("xyz", 0.0)}
    return {"direction": vector, "desired_distance": 0.0, "min_distance": 0.0}
