"""Wanted motions as tables over time: of the object itself, or in coordinates of Gamma_ucs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.documents.time_table import MODES, MOTION, Table, read_table
from synergrip.linalg import Array
from synergrip.tasks.arguments import Numbers, Rows, TaskArguments, keep
from synergrip.tasks.profiles import Tabled
from synergrip.tasks.stated import Motion, Setting


@naming_arguments
@dataclass(frozen=True, eq=False)
class MotionTable(Motion):
    """Where the object is wanted at instants which cover the task, in straight lines between them.

    Args:
        times: (K,) increasing instants [s].
        values: (K, 6) displacement from the start [m] and rotation vector about B [rad], axes of the palm.

    Raises:
        InputError: shapes that do not fit each other, numbers that are not finite, times that do not increase.

    Example:
        >>> MotionTable([0.0, 1.0], [[0, 0, 0, 0, 0, 0], [0, 0, 0.01, 0, 0, 0]])
        MotionTable(2 lines from 0 s to 1 s)
    """

    times: Numbers
    values: Rows

    def __post_init__(self) -> None:
        """Judge the arguments."""
        judge = TaskArguments("MotionTable")
        times = judge.times("times", self.times)
        what = "x, y, z [m] and a rotation vector [rad] in each row"
        keep(self, judge, times=times, values=judge.rows("values", self.values, (len(times), 6), what))

    def __repr__(self) -> str:
        """Return one line."""
        return f"MotionTable({len(self.times)} lines from {self.times[0]:g} s to {self.times[-1]:g} s)"

    @classmethod
    def from_csv(cls, path: str | Path, *, key: str = "") -> MotionTable:
        """Return the table in a CSV file with the header ``t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad``.

        Args:
            path: the file.
            key: what names the file, for errors.

        Raises:
            InputError: no such file, or one that is no such table, with line and column.
        """
        table = read_table(Path(path), MOTION, key)
        return cls(table.times, table.values)

    @property
    def lines(self) -> Array:
        """Its instants."""
        return np.asarray(self.times)

    def over(self, setting: Setting) -> Tabled:
        """Return the wanted displacement (T, 6) at any time."""
        return Tabled(Table(np.asarray(self.times), np.asarray(self.values)))


@naming_arguments
@dataclass(frozen=True, eq=False)
class ModesTable(Motion):
    """The rigid motion in coordinates of Gamma_ucs, all of them, at instants which cover the task.

    Args:
        times: (K,) increasing instants [s].
        values: (K, dim Gamma_ucs) coordinates [m], one column for each rigid motion that the synergies can produce.

    Raises:
        InputError: shapes that do not fit each other, numbers that are not finite, times that do not increase.

    Example:
        >>> ModesTable([0.0, 1.0], [[0.0], [0.01]])
        ModesTable(2 lines of 1 mode from 0 s to 1 s)
    """

    times: Numbers
    values: Rows

    def __post_init__(self) -> None:
        """Judge the arguments."""
        judge = TaskArguments("ModesTable")
        times = judge.times("times", self.times)
        width = judge.width(self.values)
        what = "coordinates of Gamma_ucs [m], a column for each"
        keep(self, judge, times=times, values=judge.rows("values", self.values, (len(times), width), what))

    def __repr__(self) -> str:
        """Return one line."""
        width = np.shape(self.values)[1]
        modes = f"{width} mode{'s' if width > 1 else ''}"
        return f"ModesTable({len(self.times)} lines of {modes} from {self.times[0]:g} s to {self.times[-1]:g} s)"

    @classmethod
    def from_csv(cls, path: str | Path, *, key: str = "") -> ModesTable:
        """Return the table in a CSV file with the header ``t_s,beta_1,beta_2,...``.

        Args:
            path: the file.
            key: what names the file, for errors.

        Raises:
            InputError: no such file, or one that is no such table, with line and column.
        """
        table = read_table(Path(path), MODES, key)
        return cls(table.times, table.values)

    @property
    def kind(self) -> Literal["modes"]:
        """Coordinates of Gamma_ucs, every one of them."""
        return "modes"

    @property
    def lines(self) -> Array:
        """Its instants."""
        return np.asarray(self.times)

    def over(self, setting: Setting) -> Tabled:
        """Return the coordinates (T, m) at any time."""
        return Tabled(Table(np.asarray(self.times), np.asarray(self.values)))
