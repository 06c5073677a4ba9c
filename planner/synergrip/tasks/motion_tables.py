"""Wanted motions as tables over time: of the object itself, or in coordinates of Gamma_ucs."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, Self

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.documents.time_table import MODES, MOTION
from synergrip.tasks.stated import Motion
from synergrip.tasks.time_tables import TimeTable


@dataclass(frozen=True, eq=False, repr=False)
class _WantedTable(TimeTable, Motion):
    """A table of where the object is wanted."""

    def stretched(self, factor: float) -> Self:
        """Return the same places at times that are multiplied."""
        return replace(self, times=factor * np.asarray(self.times))


@naming_arguments
@dataclass(frozen=True, eq=False, repr=False)
class MotionTable(_WantedTable):
    """Where the object is wanted at instants which cover the task, in straight lines between them.

    A CSV file of it has the header ``t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad``.

    Args:
        times: (K,) increasing instants [s].
        values: (K, 6) displacement from the start [m] and rotation vector about B [rad], axes of the palm.

    Raises:
        InputError: shapes that do not fit each other, numbers that are not finite, times that do not increase.

    Example:
        >>> MotionTable([0.0, 1.0], [[0, 0, 0, 0, 0, 0], [0, 0, 0.01, 0, 0, 0]])
        MotionTable(2 lines from 0 s to 1 s)
    """

    columns = MOTION
    meaning = "x, y, z [m] and a rotation vector [rad] in each row"
    turning = slice(3, 6)


@naming_arguments
@dataclass(frozen=True, eq=False, repr=False)
class ModesTable(_WantedTable):
    """The rigid motion in coordinates of Gamma_ucs, all of them, at instants which cover the task.

    A CSV file of it has the header ``t_s,beta_1,beta_2,...``.

    Args:
        times: (K,) increasing instants [s].
        values: (K, dim Gamma_ucs) coordinates [m], one column for each rigid motion that the synergies can produce.

    Raises:
        InputError: shapes that do not fit each other, numbers that are not finite, times that do not increase.

    Example:
        >>> ModesTable([0.0, 1.0], [[0.0], [0.01]])
        ModesTable(2 lines of 1 mode from 0 s to 1 s)
    """

    columns = MODES
    meaning = "coordinates of Gamma_ucs [m], a column for each"

    @property
    def _of(self) -> str:
        width = np.shape(self.values)[1]
        return f" of {width} mode{'s' if width > 1 else ''}"

    @property
    def kind(self) -> Literal["modes"]:
        """Coordinates of Gamma_ucs, every one of them."""
        return "modes"
