"""What happens in a task as a [task] table states it: knots, wrench and wanted motion, with the keys of the file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.errors import InputError
from synergrip.grasps.objects import Object
from synergrip.linalg import Array
from synergrip.problems.loads import stated_at, task_of
from synergrip.problems.task_file import TaskTable
from synergrip.tasks.profiles import Profiles
from synergrip.tasks.timed_task import Target
from synergrip.tasks.timing import happening


@dataclass(frozen=True)
class Loads:
    """What happens, knot by knot and at any time."""

    times: Array
    wrench: Array | None
    target: Target
    profiles: Profiles


def loads(table: TaskTable, folder: Path, mass: float = 0.0, body: Object | None = None) -> Loads:
    """What happens to an object, or to a bare mass at the origin of the palm."""
    body = body or (Object(mass=mass, position=np.zeros(3)) if mass else None)
    task, keys = task_of(table, folder)
    try:
        times, profiles = happening(task, body)
    except InputError as error:
        raise stated_at(error, keys) from None
    target = Target(task.target.kind, profiles.target_at(times), keys["Task.target"])
    return Loads(times, profiles.load_at(times), target, profiles)


def table(**keys: Any) -> TaskTable:
    """A [task] table."""
    return TaskTable.model_validate(keys)
