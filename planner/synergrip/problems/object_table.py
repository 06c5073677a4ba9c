"""The table of a problem file that says what is grasped: [object]."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import Field, create_model

from synergrip.documents.fields import (
    Angle,
    Axis,
    Mass,
    Table,
    Written,
    array_of,
    listed,
    unit_schema,
    with_unit,
)
from synergrip.errors import InputError, Issue
from synergrip.grasps.shapes.shape import Shape, Size
from synergrip.grasps.shapes.shapes import SHAPES

AUTO = "auto"
"""Position that is still to be found."""


def _lengths(size: Size) -> Any:
    """Return the type of a size in the file: one length, or several."""
    if size.count == 1:
        return Annotated[float, Written(with_unit("length", above=0), unit_schema("length"))]
    read = with_unit("length", above=0)
    return Annotated[
        tuple[float, ...],
        Written(lambda v: listed(read, v, size.count, "lengths"), array_of(unit_schema("length"), size.count)),
    ]


def _table(shape: type[Shape]) -> Any:
    """Return the table of a shape, with the sizes that the shape says it has."""
    sizes: dict[str, Any] = {size.name: (_lengths(size), Field(description=size.meaning)) for size in shape.sizes}
    table = create_model(
        f"{shape.__name__}Table", __base__=Table, __module__=__name__, __doc__=f"A {shape.name}.", **sizes
    )
    globals()[table.__name__] = table  # where pickle looks for it
    return table


class OneShape(Table):
    """Exactly one shape."""

    def issues(self) -> Iterable[Issue]:
        """Refuse none and more than one."""
        given = [name for name in SHAPES if getattr(self, name) is not None]
        if not given:
            *names, last = SHAPES
            yield Issue(f"name one shape: {', '.join(names)} or {last}")
        for name in given[1:]:
            yield Issue(f"an object has one shape; '{given[0]}' is given already", key=name, on_key=True)

    def value(self) -> Shape:
        """Return the shape."""
        ((shape, sizes),) = [(SHAPES[name], dict(table)) for name, table in self if table is not None]
        return shape(**sizes)


if TYPE_CHECKING:
    ShapeTable = OneShape
else:
    ShapeTable = create_model(
        "ShapeTable",
        __module__=__name__,
        __base__=OneShape,
        __doc__="Exactly one shape.",
        **{name: (_table(shape) | None, Field(default=None, description=f"a {shape.name}"))
           for name, shape in SHAPES.items()},
    )  # fmt: skip


class OrientationTable(Table):
    """A turn of the shape."""

    axis: Axis = Field(description="axis through the centre, in the palm frame")
    angle: Angle = Field(description="angle of the turn about it")


def _position(value: object) -> tuple[float, ...] | str:
    if isinstance(value, str) and value == AUTO:
        return AUTO
    if isinstance(value, str):
        raise InputError.at("", f'expected "{AUTO}" or a list of 3 lengths such as ["0 mm", "0 mm", "80 mm"]')
    return listed(with_unit("length"), value, 3, "lengths")


class ObjectTable(Table):
    """The grasped object."""

    title: str = Field(default="", description="name of the object, for people")
    shape: ShapeTable | None = Field(default=None, description=f"exactly one of {', '.join(SHAPES)}")
    mass: Mass | None = Field(default=None, description="mass; needed for gravity")
    position: Annotated[
        tuple[float, ...] | str | None,
        Written(_position, {"anyOf": [{"const": AUTO}, array_of(unit_schema("length"), 3)]}),
    ] = Field(
        default=None,
        description='centre of the object in the palm frame, or "auto": where the hand that closes touches with all '
        "contacts and the largest slip margin is best",
    )
    orientation: OrientationTable | None = Field(
        default=None, description="how the shape is turned from the axes of the palm; not at all when absent"
    )

    def issues(self) -> Iterable[Issue]:
        """Refuse a turn of nothing."""
        if self.orientation is not None and self.shape is None:
            yield Issue("an orientation turns the shape; give object.shape", key="orientation", on_key=True)
