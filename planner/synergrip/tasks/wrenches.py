"""Wrenches on the object: one that stays, or a table over time."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.documents.time_table import WRENCH, Table, read_table
from synergrip.linalg import Array, frozen
from synergrip.tasks.arguments import Numbers, Rows, TaskArguments, keep
from synergrip.tasks.profiles import Constant, Tabled
from synergrip.tasks.stated import Load, Setting

COLUMNS = "3 forces [N] and 3 moments [N m] about B, axes of the palm"


@naming_arguments
@dataclass(frozen=True)
class Wrench(Load):
    """The same wrench throughout the task.

    Args:
        values: (6,) force [N] and moment about B [N m] on the object, axes of the palm.

    Raises:
        InputError: not 6 finite numbers.

    Example:
        >>> Wrench((0, 0, -2.5, 0, 0, 0))
        Wrench(values=(0.0, 0.0, -2.5, 0.0, 0.0, 0.0))
    """

    values: Numbers

    def __post_init__(self) -> None:
        """Judge the argument."""
        judge = TaskArguments("Wrench")
        keep(self, judge, values=judge.vector("values", self.values, 6, COLUMNS))

    def over(self, setting: Setting) -> Constant:
        """Return the wrench at any time."""
        return Constant(frozen(self.values))


@naming_arguments
@dataclass(frozen=True, eq=False)
class WrenchTable(Load):
    """A wrench that is given at instants which cover the task, and is linear between them.

    Args:
        times: (K,) increasing instants [s].
        values: (K, 6) force [N] and moment about B [N m] on the object, axes of the palm.

    Raises:
        InputError: shapes that do not fit each other, numbers that are not finite, times that do not increase.

    Example:
        >>> WrenchTable([0.0, 1.0], [[0, 0, -2, 0, 0, 0], [0, 0, -3, 0, 0, 0]])
        WrenchTable(2 lines from 0 s to 1 s)
    """

    times: Numbers
    values: Rows

    def __post_init__(self) -> None:
        """Judge the arguments."""
        judge = TaskArguments("WrenchTable")
        times = judge.times("times", self.times)
        keep(self, judge, times=times, values=judge.rows("values", self.values, (len(times), 6), COLUMNS))

    def __repr__(self) -> str:
        """Return one line."""
        return f"WrenchTable({len(self.times)} lines from {self.times[0]:g} s to {self.times[-1]:g} s)"

    @classmethod
    def from_csv(cls, path: str | Path, *, key: str = "") -> WrenchTable:
        """Return the table in a CSV file with the header ``t_s,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm``.

        Args:
            path: the file.
            key: what names the file, for errors.

        Raises:
            InputError: no such file, or one that is no such table, with line and column.
        """
        table = read_table(Path(path), WRENCH, key)
        return cls(table.times, table.values)

    @property
    def lines(self) -> Array:
        """Its instants."""
        return np.asarray(self.times)

    def over(self, setting: Setting) -> Tabled:
        """Return the wrench at any time."""
        return Tabled(Table(np.asarray(self.times), np.asarray(self.values)))
