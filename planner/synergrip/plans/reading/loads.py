"""Knot times, wrench profile and wanted motion of a task, from the [task] table and its CSV files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from synergrip.errors import InputError
from synergrip.linalg import Array, frozen, interpolated
from synergrip.plans.reading.moves import moved, turned
from synergrip.plans.reading.tables import MODES, MOTION, WRENCH, Table, read_table
from synergrip.plans.reading.task_file import TaskTable
from synergrip.plans.task import Wanted, still

MOVING_KNOTS = 41
"""Knots of a task that moves or turns and does not say how many."""
COVER = 1e-9
"""Relative slack when a CSV file must cover the time of the task."""


@dataclass(frozen=True)
class Loads:
    """What happens, knot by knot."""

    times: Array  # (T,) [s]
    wrench: Array | None
    """(T, 6) external wrench on the object; None when nothing is said of it."""
    wanted: Wanted


def loads(task: TaskTable, folder: Path, mass: float) -> Loads:
    """Return what happens in a task.

    Args:
        task: the [task] table.
        folder: where its CSV files are looked for.
        mass: of the object [kg].

    Raises:
        InputError: a CSV file is broken or does not cover the task.
    """
    tables = {}
    for key, columns in (("wrench", WRENCH), ("motion", MOTION), ("modes", MODES)):
        name = getattr(task, key)
        if isinstance(name, str):
            tables[key] = read_table(folder / name, columns, f"task.{key}")
    times = _times(task, tables)
    resampled = {key: _resampled(table, times, f"task.{key}") for key, table in tables.items()}
    return Loads(frozen(times), _wrench(task, times, resampled, mass), _wanted(task, times, resampled))


def _times(task: TaskTable, tables: dict[str, Table]) -> Array:
    """Return the knots: evenly spaced when their number is given, else those of the CSV files and the end."""
    duration = task.duration
    if tables and "duration" not in task.model_fields_set:
        duration = max(float(table.times[-1]) for table in tables.values())
    if task.knots is None and tables:
        every = np.concatenate([table.times for table in tables.values()])
        return distinct(np.append(every[every < duration], duration))
    count = task.knots or (MOVING_KNOTS if task.move or task.palm else 1)
    return np.linspace(0.0, duration, count) if count > 1 else np.zeros(1)


def distinct(times: Array) -> Array:
    """Return the times in order, without those that follow another by no more than rounding."""
    ordered = np.unique(times)
    apart = np.diff(ordered) > COVER * max(float(ordered[-1]), 1.0)
    return np.asarray(ordered[np.append(apart, True)])


def _resampled(table: Table, times: Array, key: str) -> Array:
    """Return the table's values (T, m) at `times`, linear in between."""
    slack = COVER * max(float(times[-1]), 1.0)
    if table.times[0] > times[0] + slack or table.times[-1] < times[-1] - slack:
        message = (
            f"the file covers {table.times[0]:g} s to {table.times[-1]:g} s, the task {times[0]:g} s to "
            f"{times[-1]:g} s; change the file, task.duration or task.knots"
        )
        raise InputError.at(key, message)
    return interpolated(times, table.times, table.values)


def _wrench(task: TaskTable, times: Array, resampled: dict[str, Array], mass: float) -> Array | None:
    """Return the sum of weight and given wrench (T, 6); None when neither is given."""
    total: Array | None = None
    if task.wrench is not None:
        total = resampled["wrench"] if "wrench" in resampled else np.tile(np.array(task.wrench), (len(times), 1))
    if task.gravity is not None:
        weight = np.zeros((len(times), 6))
        weight[:, :3] = mass * turned(np.array(task.gravity), task.palm, times)
        total = weight if total is None else total + weight
    return total if total is None else frozen(total)


def _wanted(task: TaskTable, times: Array, resampled: dict[str, Array]) -> Wanted:
    if "motion" in resampled:
        return Wanted("motion", frozen(resampled["motion"]), "task.motion")
    if "modes" in resampled:
        return Wanted("modes", frozen(resampled["modes"]), "task.modes")
    return moved(task.move, times) if task.move else still(times)
