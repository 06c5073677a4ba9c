"""The tables of hand.toml."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from pydantic import Field

from synergrip.documents.fields import (
    Axis,
    JointEffort,
    JointValue,
    Name,
    Number,
    Ratio,
    Size,
    Table,
    Text,
    Version,
    Written,
    array_of,
    listed,
    unit_schema,
    with_unit,
)
from synergrip.errors import Issue
from synergrip.hands.follower_ranges import FollowerRanges

FILE = "hand.toml"

Point = Annotated[
    tuple[float, ...],
    Written(lambda value: listed(with_unit("length"), value, 3, "lengths"), array_of(unit_schema("length"), 3)),
]


class JointTable(Table):
    """A joint, in the order of q; its range stands in the model file."""

    name: Name = Field(description="name of the joint in the model file")
    torque_limit: Text | None = Field(
        default=None, description='largest torque ("1.5 N m"), or force of a slide; none when absent'
    )
    compliance: Text | None = Field(
        default=None, description='yield per torque ("0.025 rad/(N m)"), or per force of a slide; 0 when absent'
    )


class PadTable(Table):
    """A place that is made to touch things."""

    link: Text = Field(description="name of the link in the model file")
    point: Point = Field(description="place in the frame of the link")
    normal: Axis = Field(description="direction in which the pad pushes, in the frame of the link")
    radius: Size | None = Field(
        default=None, description="of a round pad about that place, which touches where the object is nearest"
    )


class CouplingTable(Table):
    """What moves a joint that has no actuator of its own."""

    joint: Text = Field(description="name of the joint that is followed")
    ratio: Ratio = Field(description='rotation per rotation of that joint, such as "1/3"')
    offset: JointValue = Field(default=0.0, description="angle, or length of a slide, when the followed joint is at 0")
    rigid: bool = Field(
        default=False, strict=True, description="true when no clutch or tendon lets the joints part under contact"
    )


class SynergyTable(Table):
    """A synergy set."""

    title: str = Field(default="", description="what it is, for people")
    columns: dict[Text, dict[str, Number]] | None = Field(
        default=None,
        min_length=1,
        description="weight of each joint in each synergy; followers are added through the couplings",
    )
    file: Text | None = Field(default=None, description="a synergy file beside hand.toml; instead of columns")
    offset: dict[str, JointValue] = Field(default_factory=dict, description="joint values when every synergy is at 0")
    effort_limits: dict[str, JointEffort] = Field(
        default_factory=dict, description="largest actuator effort by synergy, a force if it moves slides only"
    )

    def issues(self) -> Iterable[Issue]:
        """Refuse two sources of columns or none, an empty column and a limit that is not positive."""
        if (self.columns is None) == (self.file is None):
            yield Issue("a synergy set gives either 'columns' or 'file'")
        elif self.file is not None and self.offset:
            yield Issue("'offset' goes with 'columns'; a file has its own", key="offset", on_key=True)
        for name, column in (self.columns or {}).items():
            if not any(column.values()):
                yield Issue("a synergy moves at least one joint", key=f"columns.{name}")
        for name, limit in self.effort_limits.items():
            if limit <= 0:
                yield Issue("must be greater than 0", key=f"effort_limits.{name}")


class PostureTable(Table):
    """A posture with a name."""

    title: str = Field(default="", description="what it is, for people")
    synergies: dict[str, JointValue] | None = Field(default=None, description="values of the synergies of a set")
    set: Text | None = Field(default=None, description="the set; the first one when absent")
    joints: dict[str, JointValue] | None = Field(default=None, description="joint values; instead of synergies")

    def issues(self) -> Iterable[Issue]:
        """Refuse neither and both."""
        if (self.synergies is None) == (self.joints is None):
            yield Issue("a posture gives either 'synergies' or 'joints'")
        elif self.joints is not None and self.set is not None:
            yield Issue("'set' goes with 'synergies'", key="set", on_key=True)


class HandFile(Table):
    """A whole hand.toml."""

    version: Version = Field(alias="schema", description="1")
    title: Text = Field(description="name of the hand, for people")
    model: Text = Field(description="URDF or MJCF file, relative to hand.toml")
    palm: Text | None = Field(default=None, description="link that is the palm; the outermost one when absent")
    joint: tuple[JointTable, ...] = Field(
        min_length=1, description="every moving joint that the palm carries, in the order of q"
    )
    pads: dict[str, PadTable] = Field(default_factory=dict, description="places that are made to touch things")
    couplings: dict[str, CouplingTable] = Field(
        default_factory=dict, description="joints that follow others; before what the model file says of them"
    )
    follower_ranges: FollowerRanges = Field(
        default="keep",
        description='"ignore": joints that follow others reach as far as their couplings take them, whatever range the '
        "model file states for them",
    )
    synergies: dict[Text, SynergyTable] = Field(default_factory=dict, description="synergy sets, the default first")
    postures: dict[Text, PostureTable] = Field(default_factory=dict, description="postures with a name")
