"""The [task] table and its CSV files made into a task. What its values mean is for `tasks` to say."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from synergrip.errors import InputError, Issue, raise_issues
from synergrip.problems.motion_tables import MoveTable, PalmTable, WaypointTable
from synergrip.problems.push_table import PushTable
from synergrip.problems.task_file import TaskTable
from synergrip.tasks.gravity import Gravity
from synergrip.tasks.hold import Hold
from synergrip.tasks.motion_tables import ModesTable, MotionTable
from synergrip.tasks.moves import ModeMove, Move, Moves
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.profiles import WaypointProfile
from synergrip.tasks.pushes import Push
from synergrip.tasks.stated import Load, Motion
from synergrip.tasks.task import Task
from synergrip.tasks.waypoints import Waypoints
from synergrip.tasks.wrenches import Wrench, WrenchTable

T = TypeVar("T")
Keys = Mapping[str, str]
"""Arguments of a task, such as ``Task.loads[1].end``, and the keys of the problem file that state them."""


def task_of(table: TaskTable, folder: Path) -> tuple[Task, Keys]:
    """Return the task that a table states, without limits and goals, and where each of its arguments is stated.

    Args:
        table: the [task] table.
        folder: where its CSV files are looked for.

    Raises:
        InputError: broken CSV files, or a path of the palm that does not say how it moves.
    """
    issues, loads, keys = list[Issue](), list[Load](), {"Task": "task", "Task.allow": "allow", "Allowances": "allow"}
    for key, make in _loads(table, folder):
        load = _gathered(issues, key, make)
        if load is not None:
            keys |= {f"Task.loads[{len(loads)}]": key, f"Task.loads[{len(loads)}].inertia": "task.palm.inertia"}
            loads.append(load)
    key, wanted = _target(table, folder)
    target = _gathered(issues, key, wanted)
    raise_issues(issues)
    keys |= {"Task.target": key}
    keys |= {f"Task.target.times[{i}]": f"task.waypoint[{i}].time" for i in range(len(table.waypoint))}
    duration = table.duration if "duration" in table.model_fields_set else None
    task = Task(
        duration=duration, knots=table.knots, target=target or Hold(), loads=loads, tracking=table.tracking,
        tolerance=table.tolerance or 0.0, axes=table.axes, drift=table.drift, between=table.between,
        linearise=table.linearise, control=None if table.control is None else table.control.value(),
        load_factor=table.load_factor, motion_factor=table.motion_factor,
        time_factor=table.time_factor,
    )  # fmt: skip
    return task, keys


def stated_at(error: InputError, keys: Keys) -> InputError:
    """Return an error of a task with the keys of the problem file in place of arguments."""

    def place(issue: Issue) -> Issue:
        known = [name for name in keys if issue.key == name or issue.key.startswith((f"{name}.", f"{name}["))]
        longest = max(known, key=len, default="")
        return replace(issue, key=keys[longest] + issue.key[len(longest) :]) if known else issue

    return error.located(place)


def _gathered(issues: list[Issue], key: str, make: Callable[[], T]) -> T | None:
    """Return a value; keep at the key of the file what is wrong with it, unless that has its own place."""
    try:
        return make()
    except InputError as error:
        for issue in error.issues:  # the arguments of a push have the names of its keys, but for the point
            inside = issue.key.removeprefix("Push") if issue.key.startswith("Push.") else ""
            inside = inside.replace(".point", ".at")
            issues.append(issue if issue.file else replace(issue, key=key + inside))
        return None


def _loads(table: TaskTable, folder: Path) -> Iterator[tuple[str, Callable[[], Load]]]:
    """Yield the loads of a task with their keys, as functions that read and judge them."""
    wrench, gravity, palm = table.wrench, table.gravity, table.palm
    if isinstance(wrench, str):
        yield "task.wrench", lambda: WrenchTable.from_csv(folder / wrench, key="task.wrench")
    elif wrench is not None:
        yield "task.wrench", lambda: Wrench(wrench)
    if gravity is not None:
        yield "task.gravity", lambda: Gravity(gravity)
    if palm is not None and palm.path is not None:
        path, key = folder / palm.path, "task.palm.path"
        yield key, lambda: PalmPath.from_csv(path, inertia=palm.inertia, key=key)
    elif palm is not None:
        yield "task.palm", lambda: palm_of(palm)
    for index, push in enumerate(table.push):
        yield f"task.push[{index}]", lambda push=push: push_of(push)  # type: ignore[misc]


def _target(table: TaskTable, folder: Path) -> tuple[str, Callable[[], Motion]]:
    """Return the key of the target, and the function that reads and judges it."""
    motion, modes = table.motion, table.modes
    if motion is not None:
        return "task.motion", lambda: MotionTable.from_csv(folder / motion, key="task.motion")
    if modes is not None:
        return "task.modes", lambda: ModesTable.from_csv(folder / modes, key="task.modes")
    if table.move:
        return "task.move", lambda: Moves(tuple(map(move_of, table.move)))
    if table.waypoint:
        return "task.waypoint", lambda: waypoints_of(table.waypoint, table.profile)
    return "task", Hold


def push_of(table: PushTable) -> Push:
    """Return a push."""
    return Push(
        force=table.force, direction=table.direction, point=table.at, start=table.start, end=table.end,
        profile=table.profile, ramp=table.ramp,
    )  # fmt: skip


def palm_of(table: PalmTable) -> Palm:
    """Return the motion of a palm that turns and shifts."""
    return Palm(axis=table.axis, turn=table.turn, shift=table.shift, profile=table.profile, inertia=table.inertia)


def move_of(table: MoveTable) -> Move | ModeMove:
    """Return a move along an axis or along a mode."""
    if table.mode is not None:
        return ModeMove(mode=table.mode, amplitude=table.amplitude or 0.0, profile=table.profile)
    return Move(axis=table.axis or (), lift=table.lift, roll=table.roll, profile=table.profile)


def waypoints_of(tables: Sequence[WaypointTable], profile: WaypointProfile) -> Waypoints:
    """Return the motion through one or more waypoints."""
    times = [point.time for point in tables]
    if tables[0].modes is not None:
        return Waypoints(times=times, modes=[point.modes or () for point in tables], profile=profile)
    positions, rotations = [point.position for point in tables], [point.rotation for point in tables]
    return Waypoints(times=times, positions=positions, rotations=rotations, profile=profile)
