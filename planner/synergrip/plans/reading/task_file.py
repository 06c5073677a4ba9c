"""The table of a problem file that says what is to happen: time, gravity, wrench, motion."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Literal

from pydantic import Field

from synergrip.errors import InputError, Issue
from synergrip.fields import (
    NUMBER,
    Angle,
    Axis,
    Length,
    Size,
    Table,
    Text,
    Time,
    Vector,
    Whole,
    Written,
    array_of,
    listed,
    number,
)
from synergrip.validation import shown

Profile = Literal["min-jerk", "cubic", "linear"]
SHORTEST = 1e-6
"""Shortest task [s]."""
PROFILE = "course in time from 0 at the start to the full value at the end"


def _wrench(value: object) -> str | tuple[float, ...]:
    if isinstance(value, str) and value:
        return value
    if isinstance(value, list):
        return listed(number, value, 6)
    raise InputError.at("", f"expected the name of a CSV file or 6 numbers (N, N m), got {shown(value)}")


class PalmTable(Table):
    """How the palm turns in the world, and gravity with it."""

    axis: Axis = Field(description="axis of the turn in the palm frame: x, y, z or 3 numbers")
    turn: Angle = Field(description="angle of the whole turn")
    profile: Profile = Field(default="min-jerk", description=PROFILE)


class MoveTable(Table):
    """One motion of the object relative to the palm."""

    axis: Axis | None = Field(default=None, description="axis in the palm frame: x, y, z or 3 numbers")
    lift: Length | None = Field(default=None, description="displacement along the axis")
    roll: Angle | None = Field(default=None, description="rotation about the axis")
    mode: Annotated[int, Field(strict=True, ge=1)] | None = Field(
        default=None, description="number of a rigid motion the synergies can produce, from 1; instead of an axis"
    )
    amplitude: Length | None = Field(default=None, description="size of the motion along `mode`")
    profile: Profile = Field(default="min-jerk", description=PROFILE)

    def issues(self) -> Iterable[Issue]:
        """Refuse anything but an axis with lift or roll, or a mode with its amplitude."""
        if self.axis is None and self.mode is None:
            yield Issue('a move needs axis (with lift or roll) or mode (with amplitude), for example axis = "z"')
        elif self.axis is not None and self.mode is not None:
            yield Issue("a move has an axis or a mode, not both", key="mode", on_key=True)
        elif self.mode is not None:
            if self.amplitude is None:
                yield Issue("missing key 'amplitude'; write for example amplitude = \"10 mm\"", key="amplitude")
            for name in ("lift", "roll"):
                if getattr(self, name) is not None:
                    yield Issue(f"'{name}' goes with axis; a mode has an amplitude", key=name, on_key=True)
        else:
            if self.lift is None and self.roll is None:
                yield Issue('a move along an axis needs lift or roll, for example lift = "10 mm"')
            if self.amplitude is not None:
                yield Issue("'amplitude' goes with mode; an axis has lift and roll", key="amplitude", on_key=True)


class TaskTable(Table):
    """What is to happen."""

    duration: Time = Field(default="1 s", validate_default=True, description="duration of the task")
    knots: Annotated[Whole, Field(ge=1, le=100_000)] | None = Field(
        default=None, description="number of instants at which the plan is made, evenly spaced"
    )
    gravity: Vector | None = Field(
        default=None, description="acceleration of gravity in the palm frame at the start, in m/s^2: 3 numbers"
    )
    palm: PalmTable | None = Field(default=None, description="turn of the palm in the world, and so of gravity")
    wrench: Annotated[
        str | tuple[float, ...] | None,
        Written(_wrench, {"anyOf": [{"type": "string", "minLength": 1}, array_of(NUMBER, 6)]}),
    ] = Field(
        default=None,
        description="external wrench on the object: 6 numbers in N and N m, or a CSV file with "
        "t_s,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm",
    )
    motion: Text | None = Field(
        default=None, description="wanted motion of the object: CSV file with t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad"
    )
    modes: Text | None = Field(
        default=None, description="wanted motion in coordinates of Gamma_ucs: CSV file with t_s,beta_1,..."
    )
    tracking: Literal["rigid", "compliant"] = Field(
        default="rigid",
        description="what follows the wanted motion: the rigid part, or the object with its elastic part",
    )
    tolerance: Size | None = Field(default=None, description="largest distance between wanted and planned motion")
    move: tuple[MoveTable, ...] = Field(default=(), description="wanted motions, which add up")

    def issues(self) -> Iterable[Issue]:
        """Refuse a motion given twice, a turn that changes nothing, and too few instants to move."""
        given = [name for name in ("move", "motion", "modes") if getattr(self, name)]
        for name in given[1:]:
            yield Issue(f"the wanted motion is given already by '{given[0]}'; keep one", key=name, on_key=True)
        if self.palm is not None and self.gravity is None:
            yield Issue("turning the palm changes nothing without task.gravity", key="palm", on_key=True)
        if self.knots == 1 and (self.move or self.palm):
            yield Issue("a task that moves or turns needs at least 2 knots", key="knots")
        if self.duration < SHORTEST:
            yield Issue(f"must be at least 1 us, got {1e6 * self.duration:.3g} us", key="duration")
