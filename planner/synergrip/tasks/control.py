"""What is to be controlled independently: internal forces, object motions, reconfiguration (Theorem 1)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from synergrip.conic.limits.object_error import AXES, AxisName, axis_weights
from synergrip.documents.judging import described, is_list, is_whole, is_word
from synergrip.documents.naming import naming_arguments
from synergrip.documents.words import listed
from synergrip.errors import Refusal, one_of, repeated
from synergrip.linalg import RANK_TOLERANCE
from synergrip.statics.analysis import Analysis
from synergrip.statics.theorem1 import motion_coordinates
from synergrip.tasks.arguments import TaskArguments, keep
from synergrip.values import ByContent

MOST = 1000
"""Directions of one kind at most."""


@naming_arguments
@dataclass(frozen=True, eq=False, kw_only=True)
class Control(ByContent):
    """How many directions of each kind are to be controlled, each independently of all others.

    A hand with n_z synergies controls n_z in all: dim E_s of internal force, dim Gamma_ucs of rigid motion and
    dim Gamma_zr of reconfiguration (34). What asks for more has no plan, whatever the forces.

    Args:
        forces: independent directions of internal force.
        motions: axes along and about which the object is to be moved at will, of x, y, z, rx, ry, rz about B.
        reconfiguration: independent motions of the hand that leave object and forces alone.

    Raises:
        InputError: no such numbers, or no such axes.

    Example:
        ``Task(control=Control(forces=1, motions=("z", "rx")))``
    """

    forces: int = 0
    motions: tuple[AxisName, ...] = field(default=())
    reconfiguration: int = 0

    def __post_init__(self) -> None:
        """Judge the arguments."""
        judge = TaskArguments("Control")
        for name in ("forces", "reconfiguration"):
            if not is_whole(value := getattr(self, name)) or not 0 <= value <= MOST:
                judge.refuse(name, f"expected a whole number from 0 to {MOST}, got {described(value)}")
        axes = tuple(self.motions) if is_list(self.motions) else (self.motions,)
        for index, axis in enumerate(axes):
            if not is_word(axis, AXES):
                judge.refuse(f"motions[{index}]", one_of(axis, AXES))
        for index in repeated(map(str, axes)):
            judge.refuse(f"motions[{index}]", f"'{axes[index]}' is listed twice")
        keep(self, judge, motions=axes)

    @property
    def asked(self) -> int:
        """How many directions in all."""
        return self.forces + len(self.motions) + self.reconfiguration


class ControlError(Refusal):
    """More directions are to be controlled independently than the synergies can."""

    def __init__(self, message: str, stage: str, asked: int, available: int) -> None:
        """Carry the stage, "count" or "direction", and how many are asked for and available."""
        super().__init__(message)
        self.stage, self.asked, self.available = stage, asked, available


def refuse_control(analysis: Analysis, control: Control) -> None:
    """Refuse to control more directions than there are synergies, or such as they do not control.

    Raises:
        ControlError: with the stage, "count" or "direction".
    """
    n_z, dimensions = analysis.grasp.n_z, analysis.spaces.dimensions
    if control.asked > n_z:
        message = (
            f"asks for {control.asked} independent directions, the hand has n_z = {n_z}; {_competing(control)}; its "
            "synergies control {} of internal force, {} of motion and {} of reconfiguration".format(*dimensions)
        )
        raise ControlError(message, "count", control.asked, n_z)
    kinds = (("internal force", "E_s", control.forces, 0), ("reconfiguration", "Gamma_zr", control.reconfiguration, 2))
    for what, space, asked, place in kinds:
        if asked > dimensions[place]:
            message = (
                f"asks for {asked} independent direction{'s' * (asked != 1)} of {what}, these synergies control "
                f"{dimensions[place]} (dim {space}); {_competing(control)}"
            )
            raise ControlError(message, "direction", asked, dimensions[place])
    if out := outside(analysis, control.motions):
        message = (
            f"the object cannot be moved at will along or about {', '.join(out)}: the rigid motions of these "
            f"synergies (Gamma_ucs) have dimension {dimensions[1]}, and this is none of them"
        )
        raise ControlError(message, "direction", len(control.motions), dimensions[1])


def most_controlled(analysis: Analysis, control: Control) -> Control:
    """Return as much of what is asked for as the synergies control."""
    forces, _, reconfiguration = (min(each, most) for each, most in zip(
        (control.forces, 0, control.reconfiguration), analysis.spaces.dimensions, strict=True,
    ))  # fmt: skip
    out = outside(analysis, control.motions)
    return Control(
        forces=forces, motions=tuple(axis for axis in control.motions if axis not in out),
        reconfiguration=reconfiguration,
    )  # fmt: skip


def written(control: Control) -> str:
    """Return what is to be controlled as TOML."""
    axes = ", ".join(f'"{axis}"' for axis in control.motions)
    parts = (
        f"forces = {control.forces}" if control.forces else "",
        f"motions = [{axes}]" if axes else "",
        f"reconfiguration = {control.reconfiguration}" if control.reconfiguration else "",
    )
    return f"{{ {', '.join(part for part in parts if part)} }}"


def outside(analysis: Analysis, motions: Sequence[AxisName]) -> tuple[AxisName, ...]:
    """Return the axes of which the unit motion is no rigid motion that the synergies produce."""
    scale, units = analysis.response.scale, axis_weights(tuple(motions), 1.0)
    _, left = motion_coordinates(analysis.response, analysis.spaces, units)
    sizes, lefts = (np.linalg.norm(scale.twist(each), axis=1) for each in (units, left))
    return tuple(axis for axis, none in zip(motions, lefts <= RANK_TOLERANCE * sizes, strict=True) if not none)


def _competing(control: Control) -> str:
    """Return what competes for the synergies."""
    parts = [
        f"{control.forces} of internal force" if control.forces else "",
        f"{len(control.motions)} of motion ({', '.join(control.motions)})" if control.motions else "",
        f"{control.reconfiguration} of reconfiguration" if control.reconfiguration else "",
    ]
    return f"{listed([part for part in parts if part])} compete"
