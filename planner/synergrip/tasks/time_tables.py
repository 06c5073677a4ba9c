"""What loads and targets that are given as tables over time share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Self

import numpy as np

from synergrip.documents.time_table import Table, read_table
from synergrip.linalg import Array
from synergrip.tasks.arguments import Numbers, Rows, TaskArguments, keep
from synergrip.tasks.profiles import Tabled
from synergrip.tasks.stated import Setting, Stated


@dataclass(frozen=True, eq=False, repr=False)
class TimeTable(Stated):
    """Values at instants which cover the task, in straight lines between them."""

    times: Numbers
    values: Rows

    columns: ClassVar[Sequence[str] | str]
    """Header of a CSV file besides ``t_s``: names, or the beginning of the names of any number of columns."""
    meaning: ClassVar[str]
    """What stands in a row, for errors."""
    turning: ClassVar[slice | None] = None
    """The columns of a rotation vector; None when there are none."""

    def __post_init__(self) -> None:
        """Judge the arguments."""
        judge = TaskArguments(type(self).__name__)
        times = judge.times("times", self.times)
        width = judge.width(self.values) if isinstance(self.columns, str) else len(self.columns)
        values = judge.rows("values", self.values, (len(times), width), self.meaning)
        if self.turning is not None:
            judge.turns("values", values[:, self.turning])
        keep(self, judge, times=times, values=values)

    def __repr__(self) -> str:
        """Return one line."""
        start, end = self.times[0], self.times[-1]
        return f"{type(self).__name__}({len(self.times)} lines{self._of} from {start:g} s to {end:g} s)"

    @property
    def _of(self) -> str:
        """What the lines are of, where that is not plain."""
        return ""

    @classmethod
    def from_csv(cls, path: str | Path, *, key: str = "") -> Self:
        """Return the table in a CSV file with a column ``t_s`` and those that the class says.

        Args:
            path: the file.
            key: what names the file, for errors.

        Raises:
            InputError: no such file, or one that is no such table, with line and column.
        """
        table = read_table(Path(path), cls.columns, key)
        return cls(table.times, table.values)

    @property
    def lines(self) -> Array:
        """Its instants."""
        return np.asarray(self.times)

    def over(self, setting: Setting) -> Tabled:
        """Return the values (T, m) at any time."""
        return Tabled(Table(np.asarray(self.times), np.asarray(self.values)))
