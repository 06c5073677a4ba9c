"""Wrenches on the object: one that stays, or a table over time."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.documents.naming import naming_arguments
from synergrip.documents.time_table import WRENCH
from synergrip.linalg import frozen
from synergrip.tasks.arguments import Numbers, TaskArguments, keep
from synergrip.tasks.profiles import Constant
from synergrip.tasks.stated import Load, Setting
from synergrip.tasks.time_tables import TimeTable

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
@dataclass(frozen=True, eq=False, repr=False)
class WrenchTable(TimeTable, Load):
    """A wrench that is given at instants which cover the task, and is linear between them.

    A CSV file of it has the header ``t_s,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm``.

    Args:
        times: (K,) increasing instants [s].
        values: (K, 6) force [N] and moment about B [N m] on the object, axes of the palm.

    Raises:
        InputError: shapes that do not fit each other, numbers that are not finite, times that do not increase.

    Example:
        >>> WrenchTable([0.0, 1.0], [[0, 0, -2, 0, 0, 0], [0, 0, -3, 0, 0, 0]])
        WrenchTable(2 lines from 0 s to 1 s)
    """

    columns = WRENCH
    meaning = COLUMNS
