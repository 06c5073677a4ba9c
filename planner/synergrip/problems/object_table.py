"""The table of a problem file that says what is grasped: [object]."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from pydantic import Field

from synergrip.documents.fields import (
    Angle,
    Axis,
    Mass,
    Size,
    Table,
    Written,
    array_of,
    listed,
    unit_schema,
    with_unit,
)
from synergrip.errors import Issue


class SphereTable(Table):
    """A ball."""

    radius: Size = Field(description="radius")


class BoxTable(Table):
    """A box."""

    size: Annotated[
        tuple[float, ...],
        Written(lambda v: listed(with_unit("length", above=0), v, 3, "lengths"), array_of(unit_schema("length"), 3)),
    ] = Field(description="length of the three edges")


class CylinderTable(Table):
    """A cylinder."""

    radius: Size = Field(description="radius")
    height: Size = Field(description="height")


class ShapeTable(Table):
    """Exactly one shape."""

    sphere: SphereTable | None = Field(default=None, description="a ball")
    box: BoxTable | None = Field(default=None, description="a box")
    cylinder: CylinderTable | None = Field(default=None, description="a cylinder")

    def issues(self) -> Iterable[Issue]:
        """Refuse none and more than one."""
        given = [name for name in ("sphere", "box", "cylinder") if getattr(self, name) is not None]
        if not given:
            yield Issue("name one shape: sphere, box or cylinder")
        for name in given[1:]:
            yield Issue(f"an object has one shape; '{given[0]}' is given already", key=name, on_key=True)


class OrientationTable(Table):
    """A turn of the shape."""

    axis: Axis = Field(description="axis through the centre, in the palm frame")
    angle: Angle = Field(description="angle of the turn about it")


class ObjectTable(Table):
    """The grasped object."""

    title: str = Field(default="", description="name of the object, for people")
    shape: ShapeTable | None = Field(default=None, description="exactly one of sphere, box and cylinder")
    mass: Mass | None = Field(default=None, description="mass; needed for gravity")
    position: Annotated[
        tuple[float, ...] | None,
        Written(lambda v: listed(with_unit("length"), v, 3, "lengths"), array_of(unit_schema("length"), 3)),
    ] = Field(default=None, description="centre of the object in the palm frame")
    orientation: OrientationTable | None = Field(
        default=None, description="how the shape is turned from the axes of the palm; not at all when absent"
    )

    def issues(self) -> Iterable[Issue]:
        """Refuse a turn of nothing."""
        if self.orientation is not None and self.shape is None:
            yield Issue("an orientation turns the shape; give object.shape", key="orientation", on_key=True)
