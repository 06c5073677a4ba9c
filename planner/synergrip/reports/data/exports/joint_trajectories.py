"""An exported plan as trajectory_msgs/JointTrajectory: as YAML, and as a bag of ROS 2 without ROS."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.errors import InputError
from synergrip.linalg import Array
from synergrip.reports.data.exports.exported_plan import ExportedPlan
from synergrip.reports.data.exports.yaml_text import write_yaml

TYPE = "trajectory_msgs/msg/JointTrajectory"
PER_SECOND = 1_000_000_000
LONGEST_S = 2**31 - 1
"""What the seconds of a message hold."""
MEANINGS = {
    "joints": "where the joints are, with their torques",
    "joint_references": "where the joints would stand if they carried nothing: for position controllers of their "
    "compliance; commands, without effort",
    "synergies": "synergy references from those at the start, to be added to what the hand was told there; commands, "
    "without effort",
}
BAG_VERSION = 8


def trajectories(plan: ExportedPlan) -> dict[str, dict[str, Any]]:
    """Return the messages by name, their fields as plain values; joints only of a hand, whose places are known.

    Raises:
        InputError: times that a message cannot hold.
    """
    stamps = _stamps(plan.times)
    found = {"synergies": _message(plan.synergies, stamps, plan.dz_r)}
    if plan.hand is not None:
        joints = _message(plan.joints, stamps, plan.hand.q, plan.torques)
        found = {"joints": joints, "joint_references": _message(plan.joints, stamps, plan.hand.commanded), **found}
    return found


def trajectory_message(names: tuple[str, ...], positions: Array, efforts: Array | None = None) -> dict[str, Any]:
    """Return a message of one instant (n,)."""
    return _message(names, [(0, 0)], positions[None], None if efforts is None else efforts[None])


def empty_trajectory() -> dict[str, Any]:
    """Return a message that says nothing."""
    return {"header": header(), "joint_names": [], "points": []}


def header(frame: str = "") -> dict[str, Any]:
    """Return a std_msgs/Header without a time, which lets a trajectory begin at once."""
    return {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": frame}


def write_ros2_yaml(plan: ExportedPlan, folder: Path) -> None:
    """Write a YAML file for each message."""
    units = {"synergies": plan.synergy_units}
    for name, message in trajectories(plan).items():
        measured = ", ".join(dict.fromkeys(unit or "?" for unit in units.get(name, plan.joint_units)))
        remarks = (f"{TYPE}: {MEANINGS[name]}", f"positions in {measured}; efforts in N m (N of joints that slide)")
        write_yaml(folder / f"{name}.yaml", plan, remarks, message)


def write_mcap(plan: ExportedPlan, folder: Path) -> None:
    """Write a bag of the messages, each on a topic of its name: trajectory.mcap and metadata.yaml."""
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store, bag = get_typestore(Stores.ROS2_HUMBLE), folder / "trajectory"
    with Writer(bag, version=BAG_VERSION, storage_plugin=StoragePlugin.MCAP) as writer:
        for key, value in plan.about.items():
            writer.set_custom_data(key, value)
        for name, message in trajectories(plan).items():
            connection = writer.add_connection(f"/{name}", TYPE, typestore=store)
            writer.write(connection, 0, store.serialize_cdr(as_message(store.types, TYPE, message), TYPE))
    for path in list(bag.iterdir()):
        path.rename(folder / path.name)
    bag.rmdir()


def as_message(types: Mapping[str, Any], name: str, fields: Mapping[str, Any]) -> Any:
    """Return a message of rosbags from its fields as plain values."""
    kinds = {
        "header": "std_msgs/msg/Header", "stamp": "builtin_interfaces/msg/Time",
        "time_from_start": "builtin_interfaces/msg/Duration",
    }  # fmt: skip
    made: dict[str, Any] = {}
    for key, value in fields.items():
        if isinstance(value, Mapping):
            made[key] = as_message(types, kinds[key], value)
        elif key == "points":
            made[key] = [as_message(types, "trajectory_msgs/msg/JointTrajectoryPoint", each) for each in value]
        else:
            made[key] = np.array(value, dtype=float) if isinstance(value, list) and key != "joint_names" else value
    return types[name](**made)


def _message(
    names: tuple[str, ...], stamps: list[tuple[int, int]], positions: Array, efforts: Array | None = None
) -> dict[str, Any]:
    points = [
        {
            "positions": positions[i].tolist(), "velocities": [], "accelerations": [],
            "effort": [] if efforts is None else efforts[i].tolist(),
            "time_from_start": {"sec": seconds, "nanosec": rest},
        }
        for i, (seconds, rest) in enumerate(stamps)
    ]  # fmt: skip
    return {"header": header(), "joint_names": list(names), "points": points}


def _stamps(times: Array) -> list[tuple[int, int]]:
    """Return seconds and nanoseconds since the first knot."""
    since = times - times[0]
    if since[-1] > LONGEST_S:
        raise InputError.at("time_s", f"the plan takes {since[-1]:.3g} s; a message of ROS holds {LONGEST_S} s at most")
    stamps = [divmod(round(float(time) * PER_SECOND), PER_SECOND) for time in since]
    if any(one == other for one, other in pairwise(stamps)):
        raise InputError.at("time_s", "knots are closer than 1 ns, which messages of ROS cannot tell apart")
    return stamps
