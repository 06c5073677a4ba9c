"""Wrench and wanted motion of a task, at its knots and between them, from the [task] table and its CSV files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from synergrip.documents.time_table import MODES, MOTION, WRENCH, Table, read_table
from synergrip.errors import InputError, Issue, raise_issues
from synergrip.grasps.objects import Object
from synergrip.linalg import Array, frozen
from synergrip.plans.reading.inertia import inertia
from synergrip.plans.reading.knots import cover, knots, span
from synergrip.plans.reading.moves import moved
from synergrip.plans.reading.palm_motion import Palm, Weight, palm_motion
from synergrip.plans.reading.palm_path import judge_path, palm_path
from synergrip.plans.reading.profiles import Constant, Profile, Profiles, Tabled
from synergrip.plans.reading.pushes import Push, pushed
from synergrip.plans.reading.task_file import TaskTable
from synergrip.plans.reading.waypoints import passing
from synergrip.plans.task import Wanted

Kind = Literal["hold", "motion", "modes", "mode moves"]
PATH = "palm.path"


@dataclass(frozen=True)
class Loads:
    """What happens, knot by knot."""

    times: Array  # (T,) [s]
    wrench: Array | None
    """(T, 6) external wrench on the object; None when nothing is said of it."""
    wanted: Wanted
    profiles: Profiles
    """The same at any time, between the knots too."""


def loads(task: TaskTable, folder: Path, mass: float, thing: Object | None = None) -> Loads:
    """Return what happens in a task.

    Args:
        task: the [task] table.
        folder: where its CSV files are looked for.
        mass: of the object [kg].
        thing: the object where it is, for the load by inertia; without it a point mass at the origin of the palm.

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
    profiles = Profiles((*_load(task, tables, start, end, mass, thing), *pushes), wanted)
    wanted_motion = Wanted(kind, profiles.wanted_at(times), key)
    return Loads(frozen(times), profiles.load_at(times), wanted_motion, profiles)


def _tables(task: TaskTable, folder: Path) -> dict[str, Table]:
    """Return the CSV files of the task by their keys, or everything that is wrong with them."""
    tables, issues = dict[str, Table](), list[Issue]()
    files: tuple[tuple[str, object, tuple[str, ...] | str], ...] = (
        ("wrench", task.wrench, WRENCH), ("motion", task.motion, MOTION), ("modes", task.modes, MODES),
        (PATH, task.palm and task.palm.path, MOTION),
    )  # fmt: skip
    for key, name, columns in files:
        try:
            if isinstance(name, str):
                tables[key] = read_table(folder / name, columns, f"task.{key}")
            if key == PATH and key in tables:
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
    task: TaskTable, tables: dict[str, Table], start: float, end: float, mass: float, thing: Object | None
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
        found.append(Weight(frozen(weight), palm) if palm else Constant(frozen([*weight, 0, 0, 0])))
    if palm is not None and task.palm is not None and task.palm.inertia:
        found.append(inertia(thing, mass, palm))
    return found


def _palm(task: TaskTable, tables: dict[str, Table], start: float, end: float) -> Palm | None:
    """Return how the palm moves; None when it stands still."""
    if PATH in tables:
        return palm_path(tables[PATH], start, end)
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
