"""The entries of [task] that say how the palm and the object move: palm, move, waypoint."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Annotated

from pydantic import Field

from synergrip.documents.fields import (
    Angle,
    Axis,
    Length,
    Table,
    Text,
    Time,
    Written,
    array_of,
    listed,
    unit_schema,
    with_unit,
)
from synergrip.errors import Issue
from synergrip.tasks.profiles import SHORTEST, ProfileName

COURSE = "profile in time from 0 at the start to the full value at the end"

Lengths = Annotated[
    tuple[float, ...],
    Written(lambda v: listed(with_unit("length"), v, 3, "lengths"), array_of(unit_schema("length"), 3)),
]
Angles = Annotated[
    tuple[float, ...],
    Written(lambda v: listed(with_unit("angle"), v, 3, "angles"), array_of(unit_schema("angle"), 3)),
]
Modes = Annotated[
    tuple[float, ...],
    Written(lambda v: listed(with_unit("length"), v, None, "lengths"), array_of(unit_schema("length"))),
]


class PalmTable(Table):
    """How the palm moves in the world, gravity with it, and what that does to the object."""

    axis: Axis | None = Field(default=None, description="axis of the turn in the palm frame: x, y, z or 3 numbers")
    turn: Angle | None = Field(default=None, description="angle of the whole turn about the origin of the palm frame")
    shift: Lengths | None = Field(
        default=None, description="whole displacement of the palm: 3 lengths along its axes at the start"
    )
    profile: ProfileName = Field(default="min-jerk", description=COURSE)
    path: Text | None = Field(
        default=None,
        description="the motion of an arm instead: CSV file with t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad, the pose of "
        "the palm frame in any fixed frame",
    )
    inertia: bool = Field(
        default=False, strict=True, description="whether the moving palm loads the object by its inertia"
    )

    def issues(self) -> Iterable[Issue]:
        """Refuse a motion given twice, half a turn, no motion, a shift that changes nothing, and a start at once."""
        if self.path is not None:
            yield from self._path_issues()
        else:
            yield from self._turn_issues()

    def _path_issues(self) -> Iterable[Issue]:
        for name in ("axis", "turn", "shift", "profile"):
            if name in self.model_fields_set:
                message = f"'path' tells the whole motion of the palm; leave out '{name}', or path"
                yield Issue(message, key=name, on_key=True)

    def _turn_issues(self) -> Iterable[Issue]:
        if self.turn is None and self.shift is None:
            message = (
                'the palm needs a motion: axis with turn, for example axis = "x", turn = "90 deg", or shift, or path'
            )
            yield Issue(message)
        elif self.turn is not None and self.axis is None:
            yield Issue("missing key 'axis' (axis of the turn: x, y, z or 3 numbers)", key="axis", on_key=True)
        elif self.turn is None and self.axis is not None:
            yield Issue("'axis' goes with turn, which is missing", key="axis", on_key=True)
        if self.shift is not None and not self.inertia:
            message = "a shift loads the object by its inertia only; write inertia = true"
            yield Issue(message, key="shift", on_key=True)
        if self.inertia and self.profile == "linear":
            message = "a linear profile starts and stops at once, which no finite force does; use 'min-jerk' or 'cubic'"
            yield Issue(message, key="profile")


class MoveTable(Table):
    """One motion of the object relative to the palm."""

    axis: Axis | None = Field(default=None, description="axis in the palm frame: x, y, z or 3 numbers")
    lift: Length | None = Field(default=None, description="displacement along the axis")
    roll: Angle | None = Field(default=None, description="rotation about the axis")
    mode: Annotated[int, Field(strict=True, ge=1, le=6)] | None = Field(
        default=None, description="number of a rigid motion the synergies can produce, from 1; instead of an axis"
    )
    amplitude: Length | None = Field(default=None, description="size of the motion along `mode`")
    profile: ProfileName = Field(default="min-jerk", description=COURSE)

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


class WaypointTable(Table):
    """Where the object is wanted at one instant."""

    time: Time = Field(description="when")
    position: Lengths = Field(default=(0.0, 0.0, 0.0), description="displacement from the start: 3 lengths")
    rotation: Angles = Field(
        default=(0.0, 0.0, 0.0), description="rotation vector about B from the start, axes of the palm: 3 angles"
    )
    modes: Modes | None = Field(
        default=None, description="coordinates of Gamma_ucs instead of position and rotation: lengths"
    )

    def issues(self) -> Iterable[Issue]:
        """Refuse a pose given twice."""
        if self.modes is not None:
            for name in ("position", "rotation"):
                if name in self.model_fields_set:
                    message = f"a waypoint has modes, or position and rotation; leave out '{name}'"
                    yield Issue(message, key=name, on_key=True)


def waypoint_issues(waypoints: Sequence[WaypointTable], end: float | None) -> Iterable[Issue]:
    """Yield what is wrong between waypoints; `end` of the task [s], None when the last of them is the end."""
    earlier = 0.0
    for index, waypoint in enumerate(waypoints):
        key = f"waypoint[{index}]"
        if waypoint.time < earlier + SHORTEST:
            before = f"the one before, at {earlier:g} s" if index else "the start, at 0 s, where the object is at rest"
            yield Issue(f"must be at least 1 us after {before}, got {waypoint.time:g} s", key=f"{key}.time")
        if end is not None and waypoint.time > end * (1 + 1e-9):
            message = f"{waypoint.time:g} s is after the end of the task at {end:g} s; change it or task.duration"
            yield Issue(message, key=f"{key}.time")
        earlier = waypoint.time
        first, modes = waypoints[0].modes, waypoint.modes
        if (modes is None) != (first is None):
            kind = "position and rotation" if first is None else "modes"
            yield Issue(f"the first waypoint has {kind}; give all of them alike", key=key)
        elif modes is not None and first is not None and len(modes) != len(first):
            yield Issue(f"the first waypoint has {len(first)} modes, this one {len(modes)}", key=f"{key}.modes")
