"""The table of a task that says what is to be controlled independently."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from synergrip.conic.limits.object_error import AxisName
from synergrip.documents.fields import Table, Whole
from synergrip.tasks.control import MOST, Control

Count = Annotated[Whole, Field(ge=0, le=MOST)]


class ControlTable(Table):
    """Directions that are to be controlled, each independently of all others."""

    forces: Count = Field(default=0, description="directions of internal force")
    motions: tuple[AxisName, ...] = Field(default=(), description="axes along and about B that the object moves on")
    reconfiguration: Count = Field(default=0, description="motions of the hand that leave object and forces alone")

    def value(self) -> Control:
        """Return what is to be controlled."""
        return Control(forces=self.forces, motions=self.motions, reconfiguration=self.reconfiguration)
