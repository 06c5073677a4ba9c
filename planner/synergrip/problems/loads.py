"""Wrench and wanted motion of a task, at its knots and between them, from the [task] table and its CSV files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from synergrip.documents.time_table import MODES, MOTION, WRENCH, Table, read_table
from synergrip.errors import InputError, Issue, raise_issues
from synergrip.grasps.objects import Object
from synergrip.linalg import Array, frozen
from synergrip.problems.instants import cover, knots, span
from synergrip.problems.motion_tables import MoveTable, PalmTable, WaypointTable
from synergrip.problems.push_table import PushTable
from synergrip.problems.task_file import TaskTable
from synergrip.tasks.inertia import inertia
from synergrip.tasks.marks import SAME_TIME
from synergrip.tasks.moves import Moves
from synergrip.tasks.palm_motion import Palm, PalmMotion, Weight
from synergrip.tasks.palm_path import palm_path, rotations_of
from synergrip.tasks.profiles import SHORTEST, Constant, Profile, Profiles, Rise, Tabled, WaypointProfile
from synergrip.tasks.pushes import Push
from synergrip.tasks.timed_task import Target
from synergrip.tasks.waypoints import Waypoints

Kind = Literal["hold", "motion", "modes", "mode moves"]
PATH_TABLE = "palm.path"
PATH = "task.palm.path"
LEAST_LINES, LEAST_LINES_WITH_INERTIA = 2, 4
"""A cubic spline through fewer than 4 points is a parabola or a line: its acceleration is made up."""
LARGEST_TURN = np.pi / 2
"""From one line to the next [rad]. Beyond half a turn it would count as the smaller one the other way round, and near
that the way between the lines is a guess; this leaves room for both."""


@dataclass(frozen=True)
class Loads:
    """What happens, knot by knot."""

    times: Array  # (T,) [s]
    wrench: Array | None
    """(T, 6) external wrench on the object; None when nothing is said of it."""
    target: Target
    profiles: Profiles
    """The same at any time, between the knots too."""


def loads(task: TaskTable, folder: Path, mass: float, body: Object | None = None) -> Loads:
    """Return what happens in a task.

    Args:
        task: the [task] table.
        folder: where its CSV files are looked for.
        mass: of the object [kg].
        body: the object where it is, for the load by inertia; without it a point mass at the origin of the palm.

    Raises:
        InputError: a CSV file is broken or does not cover the task; pushes that do not fit into it, or that fall
            between the knots; a load by inertia without a mass.
    """
    tables = _tables(task, folder)
    start, end = span(task, tables)
    pushes = _pushes(task, start, end)
    times = knots(task, tables, pushes, start, end)
    for key, table in tables.items():
        cover(table, times, f"task.{key}")
    kind, key, wanted = _wanted(task, tables, start, end)
    profiles = Profiles((*_load(task, tables, start, end, mass, body), *pushes), wanted)
    wanted_motion = Target(kind, profiles.target_at(times), key)
    return Loads(frozen(times), profiles.load_at(times), wanted_motion, profiles)


def _tables(task: TaskTable, folder: Path) -> dict[str, Table]:
    """Return the CSV files of the task by their keys, or everything that is wrong with them."""
    tables, issues = dict[str, Table](), list[Issue]()
    files: tuple[tuple[str, object, tuple[str, ...] | str], ...] = (
        ("wrench", task.wrench, WRENCH), ("motion", task.motion, MOTION), ("modes", task.modes, MODES),
        (PATH_TABLE, task.palm and task.palm.path, MOTION),
    )  # fmt: skip
    for key, name, columns in files:
        try:
            if isinstance(name, str):
                tables[key] = read_table(folder / name, columns, f"task.{key}")
            if key == PATH_TABLE and key in tables:
                judge_path(tables[key], task.palm is not None and task.palm.inertia)
        except InputError as error:
            issues += error.issues
    raise_issues(issues)
    return tables


def _pushes(task: TaskTable, start: float, end: float) -> list[Push]:
    """Return all pushes, or everything that is wrong with them."""
    found, issues = list[Push](), list[Issue]()
    for index, table in enumerate(task.push):
        try:
            found.append(pushed(table, f"task.push[{index}]", start, end))
        except InputError as error:
            issues += error.issues
    raise_issues(issues)
    return found


def _load(
    task: TaskTable, tables: dict[str, Table], start: float, end: float, mass: float, body: Object | None
) -> list[Profile]:
    """Return the wrenches that act throughout the task: the given one, the weight, the load by inertia."""
    found: list[Profile] = []
    if "wrench" in tables:
        found.append(Tabled(tables["wrench"]))
    elif task.wrench is not None:
        found.append(Constant(frozen(task.wrench)))
    palm = _palm(task, tables, start, end)
    if task.gravity is not None:
        weight = mass * np.array(task.gravity)
        found.append(Weight(frozen(weight), palm))
    if palm is not None and task.palm is not None and task.palm.inertia:
        found.append(inertia(body, mass, palm))
    return found


def _palm(task: TaskTable, tables: dict[str, Table], start: float, end: float) -> Palm | None:
    """Return how the palm moves; None when it stands still."""
    if PATH_TABLE in tables:
        return palm_path(tables[PATH_TABLE], start, end)
    return None if task.palm is None else palm_motion(task.palm, start, end)


def _wanted(task: TaskTable, tables: dict[str, Table], start: float, end: float) -> tuple[Kind, str, Profile]:
    """Return the kind of the wanted motion, its key in the problem file, and the motion."""
    if "motion" in tables:
        return "motion", "task.motion", Tabled(tables["motion"])
    if "modes" in tables:
        return "modes", "task.modes", Tabled(tables["modes"])
    if task.move:
        moves = moved(task.move, start, end)
        return "mode moves" if moves.along_modes else "motion", "task.move", moves
    if task.waypoint:
        kind: Kind = "motion" if task.waypoint[0].modes is None else "mode moves"
        return kind, "task.waypoint", passing(task.waypoint, task.profile)
    return "hold", "", Constant(np.zeros(0))


def pushed(table: PushTable, key: str, start: float, end: float) -> Push:
    """Return a push in a task from `start` to `end` [s]; `key` is that of its entry, for errors.

    Raises:
        InputError: it is not over before the task, not after it began, or too short for its ramps.
    """
    first, last = start if table.start is None else table.start, end if table.end is None else table.end
    if last > end + SAME_TIME * max(end, 1.0):
        message = f"the push ends at {last:g} s, after the task, which ends at {end:g} s; change it or task.duration"
        raise InputError.at(f"{key}.end", message)
    if last - first <= SAME_TIME * max(end, 1.0):
        name = "end" if table.end is not None else "start"
        raise InputError.at(f"{key}.{name}", f"the push begins at {first:g} s and must end later, not at {last:g} s")
    ramp = table.ramp or 0.0
    if 2 * ramp > (last - first) * (1 + SAME_TIME):
        message = f"two ramps of {ramp:g} s do not fit into a push of {last - first:g} s; at most half of it each"
        raise InputError.at(f"{key}.ramp", message)
    force = table.force * np.array(table.direction)
    return Push(frozen(np.concatenate([force, np.cross(table.at, force)])), table.profile, first, last, ramp)


def passing(waypoints: Sequence[WaypointTable], profile: WaypointProfile) -> Waypoints:
    """Return the motion through one or more waypoints, from rest in the pose of the start at 0 s."""
    poses = np.array([point.modes or (*point.position, *point.rotation) for point in waypoints])
    start = np.zeros((1, poses.shape[1]))
    times = [0.0, *(point.time for point in waypoints)]
    return Waypoints(frozen(times), frozen(np.vstack([start, poses])), profile)


def moved(moves: Sequence[MoveTable], start: float, end: float) -> Moves:
    """Return the sum of one or more moves in a task from `start` to `end` [s].

    Raises:
        InputError: moves along axes and along modes are mixed.
    """
    by_mode = [move for move in moves if move.mode is not None]
    if by_mode and len(by_mode) < len(moves):
        raise InputError.at("task.move", "moves along an axis and moves along a mode cannot be mixed")
    width = max((move.mode or 0 for move in by_mode), default=6)
    parts = tuple((Rise(move.profile, start, end), _whole(move, width)) for move in moves)
    return Moves(parts, along_modes=bool(by_mode))


def _whole(move: MoveTable, width: int) -> Array:
    """Return where a move leads."""
    if move.mode is not None:
        return frozen((move.amplitude or 0.0) * np.eye(1, width, move.mode - 1)[0])
    axis = np.asarray(move.axis, dtype=float)
    return frozen(np.concatenate([(move.lift or 0.0) * axis, (move.roll or 0.0) * axis]))


def palm_motion(table: PalmTable, start: float, end: float) -> PalmMotion:
    """Return the motion of the palm in a task from `start` to `end` [s]."""
    axis, shift = table.axis or (0.0, 0.0, 1.0), table.shift or np.zeros(3)
    return PalmMotion(frozen(axis), table.turn or 0.0, frozen(shift), Rise(table.profile, start, end))


def judge_path(table: Table, inertia: bool) -> None:
    """Refuse a path that does not say how the palm moves between its lines.

    Raises:
        InputError: too few lines, lines that are less than a microsecond apart, or a turn between two lines that is
            too large to tell which way it goes.
    """
    if len(table.times) < (LEAST_LINES_WITH_INERTIA if inertia else LEAST_LINES):
        needed = f"a path takes at least {LEAST_LINES} lines"
        if inertia:
            needed = f"the load by inertia needs accelerations, which take at least {LEAST_LINES_WITH_INERTIA} lines"
        raise InputError.at(PATH, f"{needed} below the header, got {len(table.times)}")
    steps, rotations = np.diff(table.times), rotations_of(table)
    if steps.min() < SHORTEST:
        at = table.times[steps.argmin()]
        raise InputError.at(PATH, f"lines must be at least 1 us apart; after {at:g} s it is {1e6 * steps.min():.3g} us")
    turns = np.atleast_1d((rotations[:-1].inv() * rotations[1:]).magnitude())
    if turns.max() > LARGEST_TURN * (1 + SAME_TIME):
        index = int(turns.argmax())
        message = (
            f"the palm turns by {np.degrees(turns[index]):.3g} deg from {table.times[index]:g} s to "
            f"{table.times[index + 1]:g} s, and which way is not clear; write lines between them, so that it is at "
            "most 90 deg from one to the next"
        )
        raise InputError.at(PATH, message)
