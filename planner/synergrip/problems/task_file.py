"""The table of a problem file that says what is to happen: time, gravity, wrench, motion."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Literal

from pydantic import Field

from synergrip.conic.limits.object_error import AXES, AxisName
from synergrip.documents.fields import (
    NUMBER,
    NotNegative,
    Positive,
    Size,
    Table,
    Text,
    Time,
    Whole,
    Written,
    array_of,
    listed,
    listed_by,
    unit_schema,
)
from synergrip.documents.numbers import number_or
from synergrip.documents.quantities import kind_of, without_unit
from synergrip.documents.validation import shown
from synergrip.errors import InputError, Issue, repeated
from synergrip.problems.control_table import ControlTable
from synergrip.problems.motion_tables import MoveTable, PalmTable, WaypointTable, waypoint_issues
from synergrip.problems.push_table import PushTable
from synergrip.tasks.knots import MOST_KNOTS
from synergrip.tasks.profiles import SHORTEST, WaypointProfile

_COMPONENTS = (*[number_or("force")] * 3, *[number_or("torque")] * 3)
_COMPONENT = {"anyOf": [NUMBER, unit_schema("force", "torque")]}
_ACCELERATION = {"anyOf": [NUMBER, unit_schema("acceleration")]}


def _wrench(value: object) -> str | tuple[float, ...]:
    if isinstance(value, str) and value and kind_of(value, ("force", "torque")) is None:
        return value
    if isinstance(value, list):
        return listed_by(_COMPONENTS, value, "numbers")
    kind = kind_of(value, ("force", "torque"))
    example = {"force": f'[0, 0, "{value}", 0, 0, 0]', "torque": f'[0, 0, 0, 0, 0, "{value}"]'}.get(kind or "")
    advice = f"; write for example {example}" if example else ""
    raise InputError.at("", f"expected the name of a CSV file or 6 numbers (N, N m), got {shown(value)}{advice}")


def _gravity(value: object) -> tuple[float, ...]:
    if isinstance(value, list):
        return listed(number_or("acceleration"), value, 3)
    size = value if kind_of(value, ("acceleration",)) else without_unit(value, "acceleration").split('"')[-2]
    advice = f'; write for example [0, 0, "-{str(size).strip().lstrip("+-")}"]'
    raise InputError.at("", f"expected a list of 3 numbers, got {shown(value)}{advice}, along the axes of the palm")


class TaskTable(Table):
    """What is to happen."""

    duration: Time = Field(default="1 s", validate_default=True, description="duration of the task")
    knots: Annotated[Whole, Field(ge=1, le=MOST_KNOTS)] | None = Field(
        default=None, description="number of instants at which the plan is made, evenly spaced"
    )
    gravity: Annotated[tuple[float, ...] | None, Written(_gravity, array_of(_ACCELERATION, 3))] = Field(
        default=None,
        description='acceleration of gravity in the palm frame at the start: 3 numbers in m/s^2 or "-9.81 m/s^2"',
    )
    palm: PalmTable | None = Field(
        default=None, description="motion of the palm in the world: turns gravity, and loads the object by inertia"
    )
    wrench: Annotated[
        str | tuple[float, ...] | None,
        Written(_wrench, {"anyOf": [{"type": "string", "minLength": 1}, array_of(_COMPONENT, 6)]}),
    ] = Field(
        default=None,
        description="external wrench on the object: 6 numbers in N and N m, or a CSV file with "
        "t_s,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm",
    )
    load_factor: NotNegative = Field(default=1.0, description="by which the whole load is multiplied, gravity included")
    push: tuple[PushTable, ...] = Field(default=(), description="forces on the object for some time, which add up")
    motion: Text | None = Field(
        default=None, description="wanted motion of the object: CSV file with t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad"
    )
    modes: Text | None = Field(
        default=None, description="wanted motion in coordinates of Gamma_ucs: CSV file with t_s,beta_1,..."
    )
    motion_factor: NotNegative = Field(default=1.0, description="by which the wanted motion is multiplied")
    time_factor: Positive = Field(
        default=1.0, description="by which the time of the task, of its motion and of the palm's is multiplied"
    )
    tracking: Literal["rigid", "compliant"] = Field(
        default="rigid",
        description="what follows the wanted motion: the rigid part, or the object with its elastic part",
    )
    tolerance: Size | None = Field(default=None, description="largest distance between wanted and planned motion")
    axes: Annotated[tuple[AxisName, ...], Field(min_length=1)] = Field(
        default=AXES, description="on which axes about B the wanted motion is asked for: x, y, z, rx, ry, rz"
    )
    control: ControlTable | None = Field(
        default=None, description="how many directions are to be controlled independently of each other"
    )
    between: Literal["report", "hold"] | None = Field(
        default=None,
        description="what happens between the knots: reported, or kept within all limits by a reserve at the knots; "
        "kept by the hand that moves when absent",
    )
    linearise: Literal["once", "along"] = Field(
        default="along",
        description="where a grasp on a hand is linearised: along the motion, at the true equilibria, or once, at the "
        "start posture",
    )
    drift: Size | None = Field(
        default=None, description="how far the object may move on the other axes; no bound when absent"
    )
    move: tuple[MoveTable, ...] = Field(default=(), description="wanted motions, which add up")
    waypoint: tuple[WaypointTable, ...] = Field(default=(), description="where the object is wanted, one after another")
    profile: WaypointProfile = Field(default="min-jerk", description="course in time from one waypoint to the next")

    @property
    def curved(self) -> bool:
        """True when something bends between the lines of all tables: what is timed, and a path of the palm."""
        return self.timed or (self.palm is not None and self.palm.path is not None)

    @property
    def timed(self) -> bool:
        """True when something happens that no table tells: waypoints, pushes that come and go, a palm with inertia."""
        pushes = any(not push.lasting for push in self.push)
        palm = self.palm is not None and self.palm.path is None and self.palm.inertia
        return bool(self.waypoint) or pushes or palm

    def issues(self) -> Iterable[Issue]:
        """Refuse a motion given twice, what changes nothing, and too few instants to move."""
        yield from self._motion_issues()
        yield from self._tracking_issues()
        if self.palm is not None and self.gravity is None and not self.palm.inertia:
            message = "turning the palm changes nothing without task.gravity or inertia = true"
            yield Issue(message, key="palm", on_key=True)
        if self.knots == 1 and (self.move or self.palm or self.curved):
            what = "a task that moves or turns" if self.move or self.palm or self.waypoint else "a push for some time"
            yield Issue(f"{what} needs at least 2 knots", key="knots")
        if self.duration < SHORTEST:
            yield Issue(f"must be at least 1 us, got {1e6 * self.duration:.3g} us", key="duration")

    def _motion_issues(self) -> Iterable[Issue]:
        given = [name for name in ("move", "motion", "modes", "waypoint") if getattr(self, name)]
        for name in given[1:]:
            yield Issue(f"the wanted motion is given already by '{given[0]}'; keep one", key=name, on_key=True)
        if "profile" in self.model_fields_set and not self.waypoint:
            message = "'profile' is the way between waypoints, and there are none; a move has its own"
            yield Issue(message, key="profile", on_key=True)
        yield from waypoint_issues(self.waypoint, self.duration if "duration" in self.model_fields_set else None)

    def _tracking_issues(self) -> Iterable[Issue]:
        if self.tracking == "compliant" and self.tolerance is None:
            message = "compliant tracking needs 'tolerance', how far the object may be from where it is wanted: "
            yield Issue(message + 'write for example tolerance = "0.5 mm"', key="tracking")
        for index in repeated(self.axes):
            yield Issue(f"'{self.axes[index]}' is listed twice", key=f"axes[{index}]")
        if self.drift is not None and len(self.axes) == len(AXES):
            yield Issue("'drift' is for the axes that 'axes' leaves out, and it leaves none", key="drift", on_key=True)
