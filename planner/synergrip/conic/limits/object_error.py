"""How far the object may be from where it is wanted, in all or some of its six axes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, Self, get_args

import numpy as np

from synergrip.conic.arguments import size
from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.dial import Dial
from synergrip.conic.limits.file_key import FileKey
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.rows import Rows, norm_within
from synergrip.documents.fields import Size
from synergrip.documents.judging import Arguments, is_list, is_word
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, one_of
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.statics.motion import Motion

AxisName = Literal["x", "y", "z", "rx", "ry", "rz"]
AXES: tuple[AxisName, ...] = ("x", "y", "z", "rx", "ry", "rz")
"""Translations along and rotations about the palm's axes, about B."""

Part = Literal["whole", "rigid"]


@naming_arguments
@dataclass(frozen=True)
class ObjectError(Limit):
    """``||D (u - wanted)|| <= limit`` over the chosen axes, D = diag(1, 1, 1, L, L, L), L the characteristic length.

    u is the whole displacement of the object, sag under load included, or the rigid part Gamma_ucs beta of it.

    Args:
        limit: largest distance [m].
        axes: which of "x", "y", "z", "rx", "ry", "rz" count.
        part: "whole" or "rigid".
        key: what asks for it, in messages and proofs.
        title: in tables and pictures.

    Raises:
        InputError: no length greater than 0, no such axes, no such part.

    Example:
        ``ObjectError(limit=2e-3, axes=("x", "y", "z"))``
    """

    limit: float
    axes: tuple[AxisName, ...] = AXES
    part: Part = "whole"
    key: str = field(default="limits.drift", repr=False)
    title: str = field(default="object drift", repr=False)
    watches = "motion"

    def __post_init__(self) -> None:
        """Judge length, axes and part."""
        judge = Arguments("ObjectError")
        for name in ("key", "title"):
            judge.text(name, getattr(self, name), empty=False)
        judge.finish()
        found = size("ObjectError.limit", self.limit, "a length in metres greater than 0", above=0.0)
        axes = (self.axes,) if isinstance(self.axes, str) else tuple(self.axes) if is_list(self.axes) else (self.axes,)
        for index, axis in enumerate(axes):
            if not is_word(axis, AXES):
                raise InputError.at("ObjectError.axes", one_of(axis, AXES))
            if axis in axes[:index]:
                raise InputError.at("ObjectError.axes", f"'{axis}' is listed twice")
        if not axes:
            raise InputError.at("ObjectError.axes", f"expected one or more of {', '.join(AXES)}, got none")
        if not is_word(self.part, get_args(Part)):
            raise InputError.at("ObjectError.part", one_of(self.part, get_args(Part)))
        object.__setattr__(self, "limit", found)
        object.__setattr__(self, "axes", axes)

    def dials(self, grasp: Grasp) -> tuple[Dial[Limit], ...]:
        """The distance."""
        return (Dial("drift", self.key, self.limit, "m", lambda value: replace(self, limit=value)),)

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return one second-order cone per knot, in units of the limit."""
        return [norm_within(self.key, "object", self._error(formulation), self.limit)]

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array]:
        """Return the error in each of the axes, and the limit."""
        return self._error(formulation), np.full(len(self.axes), self.limit)

    def loosened(self, share: float) -> Self:
        """Return it with a limit larger by `share`."""
        return replace(self, limit=self.limit * (1 + share))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the size of the error."""
        reached = motion.du
        if self.part == "rigid":
            reached = formulation.rigid_motion(motion.dz_r)
        size = np.linalg.norm((reached - formulation.target) @ self._weights(formulation).T, axis=1)
        return norm_usage(self.title, "m", "object", size, self.limit, motion.times)

    def _error(self, formulation: Formulation) -> Affine:
        whole = formulation.displacement if self.part == "whole" else formulation.rigid
        return whole.plus(-formulation.target).after(self._weights(formulation))

    def _weights(self, formulation: Formulation) -> Array:
        """Return the rows of D (len(axes), 6) that count."""
        return axis_weights(self.axes, formulation.response.scale.length)


def axis_weights(axes: Sequence[AxisName], length: float) -> Array:
    """Return the rows of diag(1, 1, 1, L, L, L) of the named axes, (len(axes), 6)."""
    whole = np.diag([1.0] * 3 + [length] * 3)
    return whole[[AXES.index(axis) for axis in axes]]


IN_FILE = FileKey(
    "drift", ObjectError, Size, "how far the object may be from where it is wanted, sag under load included",
)  # fmt: skip


def norm_usage(title: str, unit: str, item: str, norm: Array, limit: float, times: Array) -> Usage:
    """Return the usage of ``norm <= limit``, norm (T,)."""
    none, bound = frozen([-np.inf]), frozen([limit])
    return Usage(title, unit, (item,), norm[:, None], none, bound, bound, times)
