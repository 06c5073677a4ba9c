"""Normal force of every contact within a range."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Annotated, Any, Self

import numpy as np

from synergrip.conic.arguments import size
from synergrip.conic.bounds import one_bound
from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.dial import Dial, quantity
from synergrip.conic.limits.file_key import FileKey
from synergrip.conic.limits.friction_cone import carried
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.limits.usage import alike
from synergrip.conic.rows import Rows
from synergrip.documents.fields import Written, array_of, listed, unit_schema, with_unit
from synergrip.documents.judging import described, is_number
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, sealed
from synergrip.statics.motion import Motion

MOST = 1e9
"""[N] More than any force, where a file has to name a largest one."""
FAR = 1e3
"""A bound this many times the force unit hardly binds."""


@naming_arguments
@dataclass(frozen=True)
class NormalForce(Limit):
    """``lower <= n <= upper`` at every contact.

    Args:
        lower: least normal force [N].
        upper: largest normal force [N]; infinity for none.
        key: what asks for it, in messages and proofs.

    Raises:
        InputError: no forces of at least 0, or a lower bound above the upper one.

    Example:
        ``NormalForce(upper=20.0)``, ``NormalForce(lower=0.5, upper=20.0)``
    """

    lower: float = 0.0
    upper: float = np.inf
    key: str = field(default="limits.normal_force", repr=False)
    watches = "forces"

    def __new__(cls, *bounds: float, **named: Any) -> Self:
        """Refuse one bound without a name, which would be the lower one where most people mean the upper one."""
        if len(bounds) == 1 and "upper" not in named:
            got = described(bounds[0])
            raise InputError.at("NormalForce", f"one force without a name; write upper={got} or lower={got}")
        return super().__new__(cls)

    def __post_init__(self) -> None:
        """Judge the bounds; a lower one of minus infinity stands for none."""
        lower = _bound("NormalForce.lower", self.lower, -np.inf)
        upper = _bound("NormalForce.upper", self.upper, np.inf)
        if lower > upper:
            message = f"the lower bound {lower:g} N is above the upper bound {upper:g} N; swap them"
            raise InputError.at("NormalForce.lower", message)
        if upper == 0:
            raise InputError.at("NormalForce.upper", "the largest normal force must be greater than 0 N")
        object.__setattr__(self, "lower", lower)
        object.__setattr__(self, "upper", upper)

    def dials(self, grasp: Grasp) -> tuple[Dial[Limit], ...]:
        """The largest force, and the least one where there is one."""
        upper, lower = self.upper, self.lower
        found: list[Dial[Limit]] = []
        if np.isfinite(upper):
            found.append(
                Dial("force_cap", self.key, upper, "N", lambda value: replace(self, upper=value),
                     written=lambda value: _written(lower, value))
            )  # fmt: skip
        if lower > 0:
            found.append(
                Dial("force_cap", self.key, lower, "N", lambda value: replace(self, lower=value), "down", 0.0,
                     written=lambda value: _written(value, upper))
            )  # fmt: skip
        return tuple(found)

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return two bounds per contact, in `bound_unit`; that contacts push, friction cones say already."""
        grasp, unit = formulation.response.grasp, formulation.force_unit
        value, names = formulation.force.taken(grasp.normal_rows), grasp.contact_names
        bounds = [("lowest", self.lower)] if self.lower > 0 else []
        bounds += [("highest", self.upper)] if self.upper < np.inf else []
        return [one_bound(self.key, names, value, bound, bound_unit(bound, unit), side) for side, bound in bounds]

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array] | None:
        """Return the whole forces, which a largest normal force bounds through the cones; nothing without them."""
        if not cones_hold or not np.isfinite(self.upper):
            return None
        contacts = formulation.response.grasp.contacts
        return formulation.force, np.concatenate([contact.kind.most * self.upper for contact in contacts])

    def loosened(self, share: float) -> Self:
        """Return it with a range wider by `share` of its ends."""
        return replace(self, lower=self.lower - share * abs(self.lower), upper=self.upper + share * abs(self.upper))

    def whole(self, usage: Usage) -> Array:
        """Return the bound that is nearer to being missed; what forces are measured against where there is none."""
        ends = np.where(usage.value.max(axis=0) > usage.upper, np.abs(usage.upper), np.abs(usage.lower))
        return np.where(np.isfinite(ends) & (ends > 0), ends, usage.scale)

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the normal forces."""
        grasp, count = formulation.response.grasp, formulation.response.grasp.n_c
        normal = sealed(motion.forces[:, grasp.normal_rows])
        return Usage.of_known(
            title="normal force", unit="N", items=grasp.contact_names, value=normal,
            lower=alike(count, self.lower), upper=alike(count, self.upper), scale=alike(count, formulation.load_size),
            times=motion.times, allowance=carried(formulation, motion),
        )  # fmt: skip


def _bound(key: str, value: Any, none: float) -> float:
    """Return a bound [N]; `none` stands for no bound."""
    if is_number(value) and value == none:
        return float(none)
    word = "infinity" if none > 0 else "minus infinity"
    return size(key, value, f"a force in newtons of at least 0, or {word} for no bound", at_least=0.0)


def least_normal_force(limits: Sequence[Limit]) -> float:
    """Return the largest of the least normal forces that limits ask for [N]; 0 where none asks for any."""
    return max([0.0, *(limit.lower for limit in limits if isinstance(limit, NormalForce))])


def bound_unit(bound: float, force_unit: float) -> float:
    """Return the unit [N] of the rows of a bound: its own where it is far from all forces, to drown nothing."""
    return abs(bound) if np.isfinite(bound) and abs(bound) > FAR * force_unit else force_unit


def normal_selection(formulation: Formulation) -> Array:
    """Return (n_c, n_l): the normal component of each contact."""
    grasp = formulation.response.grasp
    return np.eye(grasp.n_l)[grasp.normal_rows]


def _written(lower: float, upper: float) -> str:
    """Return a range of forces as TOML."""
    ends = (quantity(lower, "N"), quantity(min(upper, MOST), "N"))
    return ends[1] if lower <= 0 else f"[{', '.join(ends)}]"


_force = with_unit("force", at_least=0)


def _range(value: object) -> tuple[float, float]:
    low, high = listed(_force, value, 2, "forces") if isinstance(value, list) else (0.0, _force(value))
    if low > high:
        raise InputError.at("", f"the least force {low:g} N exceeds the largest, {high:g} N")
    if high == 0:
        raise InputError.at("", "the largest normal force must be greater than 0 N")
    return low, high


_Range = Annotated[
    tuple[float, float], Written(_range, {"anyOf": [unit_schema("force"), array_of(unit_schema("force"), 2)]})
]
IN_FILE = FileKey(
    "normal_force", NormalForce, _Range, "largest normal force of a contact, or [least, largest]",
    lambda value, grasp: NormalForce(*value),
)  # fmt: skip
