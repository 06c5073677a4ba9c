"""The entry of [task] for a push: a force on the object for some time."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from pydantic import Field

from synergrip.documents.fields import Axis, Force, Table, Time, Written, unit_schema, with_unit
from synergrip.errors import Issue
from synergrip.problems.motion_tables import Lengths
from synergrip.tasks.pushes import PushProfile

Instant = Annotated[float, Written(with_unit("time", at_least=0), unit_schema("time"))]


class PushTable(Table):
    """One force on the object, with its moment about B."""

    force: Force = Field(description="largest size of the force")
    direction: Axis = Field(description="direction in the palm frame: x, y, z or 3 numbers")
    at: Lengths = Field(default=(0.0, 0.0, 0.0), description="where the force acts, from B: 3 lengths; B when absent")
    start: Instant | None = Field(default=None, description="when it begins; at the start of the task when absent")
    end: Time | None = Field(default=None, description="when it is over; at the end of the task when absent")
    profile: PushProfile = Field(default="step", description="profile of the force between start and end")
    ramp: Time | None = Field(default=None, description="time to the full force, and back, of a trapezoid")

    @property
    def lasting(self) -> bool:
        """True for a force that is the same throughout the task."""
        return self.profile == "step" and self.start is None and self.end is None

    def issues(self) -> Iterable[Issue]:
        """Refuse a trapezoid without a ramp, and a ramp of anything else."""
        if self.profile == "trapezoid" and self.ramp is None:
            yield Issue('a trapezoid needs ramp, for example ramp = "0.1 s"', key="profile")
        if self.profile != "trapezoid" and self.ramp is not None:
            yield Issue(f"'ramp' is for a trapezoid; the profile is '{self.profile}'", key="ramp", on_key=True)
