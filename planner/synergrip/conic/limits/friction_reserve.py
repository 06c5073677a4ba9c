"""Every contact force inside a friction cone that is narrower than the true one: by an angle, or by a factor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Annotated, Self

import numpy as np

from synergrip.conic.arguments import OneOrEach, one_each, size, sizes
from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.dial import Dial, quantity
from synergrip.conic.limits.file_key import FileKey
from synergrip.conic.limits.friction_cone import FrictionCone, friction_rows
from synergrip.conic.limits.limit import Limit, Usage, Watches
from synergrip.conic.rows import Rows
from synergrip.documents.fields import Written, unit_schema, with_unit
from synergrip.documents.naming import naming_arguments
from synergrip.documents.numbers import number
from synergrip.errors import InputError, Issue, raise_issues
from synergrip.linalg import Array, frozen
from synergrip.statics.motion import Motion

if TYPE_CHECKING:
    from synergrip.grasps.grasp import Grasp

LEAST = 1e-6
"""Share of an angle that is as good as none, which it cannot be."""
SHARE = "a share of the reserve from -1 to 1"


@naming_arguments
@dataclass(frozen=True, eq=False)
class FrictionReserve(Limit):
    """``ratio mu n >= ||(t, o)||`` at every contact, and its soft kin with ``ratio nu``.

    An angle phi to the cone is the ratio ``tan(atan(mu) - phi) / mu``, a safety factor s the ratio ``1 / s``
    (docs/theory.md). One of the three is given.

    Args:
        factor: by which friction may be smaller than stated before a contact slips, 1 or more.
        angle: that every contact force keeps to its cone [rad].
        ratios: share of its friction that a contact may use, between 0 and 1: one for all, or one for each.
        given_up: share of the reserve that is given up, for rounding, between -1 and 1; more is asked for below 0.

    Raises:
        InputError: none or several of them, or one that is no such number.

    Example:
        ``FrictionReserve(factor=1.2)``, ``FrictionReserve(angle=np.radians(3))``
    """

    factor: float | None = None
    angle: float | None = None
    ratios: OneOrEach = None
    given_up: float = field(default=0.0, repr=False)

    def __post_init__(self) -> None:
        """Judge what is given."""
        given = [name for name in ("factor", "angle", "ratios") if getattr(self, name) is not None]
        if len(given) != 1:
            got = " and ".join(given) or "none of them"
            raise InputError.at("FrictionReserve", f"expected one of factor, angle and ratios, got {got}")
        if self.factor is not None:
            size("FrictionReserve.factor", self.factor, "a factor of at least 1", at_least=1.0)
        if self.angle is not None:
            angle = size("FrictionReserve.angle", self.angle, "an angle in radians greater than 0", above=0.0)
            if angle >= np.pi / 2:
                message = f"expected an angle in radians less than a right one, got {angle:g}; np.radians takes degrees"
                raise InputError.at("FrictionReserve.angle", message)
        if self.ratios is not None:
            ratios = sizes("FrictionReserve.ratios", self.ratios, "contact")
            if np.any(ratios > 1):
                message = f"expected shares of the friction between 0 and 1, got {float(ratios.max()):g}"
                raise InputError.at("FrictionReserve.ratios", message)
            object.__setattr__(self, "ratios", ratios)
        if size("FrictionReserve.given_up", self.given_up, SHARE, at_least=-1.0) > 1:
            raise InputError.at("FrictionReserve.given_up", f"expected {SHARE}, got {self.given_up:g}")

    @property
    def key(self) -> str:
        """Key in the problem file: a reserve is stated as an angle, or as a factor."""
        return "limits.safety_factor" if self.angle is None else "limits.margin_angle"

    @property
    def watches(self) -> Watches:
        """Forces alone."""
        return "forces"

    @property
    def title(self) -> str:
        """Name in reports."""
        if self.angle is not None:
            return f"slip margin {np.degrees(self.angle):.4g} deg inside the cone"
        return "slip margin with reserve" if self.factor is None else f"slip margin at friction / {self.factor:.4g}"

    def dials(self, grasp: Grasp) -> tuple[Dial[Limit], ...]:
        """Angle or factor, whichever is stated."""
        if self.angle:
            return (
                Dial(
                    "margin", self.key, self.angle, "rad", lambda value: replace(self, angle=value), "down",
                    LEAST * self.angle, written=lambda value: quantity(np.degrees(value), "deg"), smooth=False,
                ),
            )  # fmt: skip
        if self.factor is None or self.factor <= 1:
            return ()
        found: Dial[Limit] = Dial("margin", self.key, self.factor, "", lambda v: replace(self, factor=v), "down", 1.0)
        return (replace(found, smooth=False),)

    def on(self, grasp: Grasp) -> Self:
        """Return it with one ratio for each contact, where ratios are given.

        Raises:
            InputError: a friction cone that is narrower than the angle, or ratios for other contacts.
        """
        used = self.used(grasp)
        return self if self.ratios is None or self.given_up else replace(self, ratios=used)

    def used(self, grasp: Grasp) -> Array:
        """Return the share (n_c,) of its friction that each contact of a grasp may use.

        Raises:
            InputError: a friction cone that is narrower than the angle, or ratios for other contacts.
        """
        if self.angle is not None:
            ratios = _ratios(grasp, self.angle)
        else:
            given = self.ratios if self.factor is None else 1 / self.factor
            names = grasp.contact_names
            ratios = one_each("FrictionReserve.ratios", np.asarray(given), names, "contact")
        return frozen(np.maximum(ratios + self.given_up * (1 - ratios), 0.0))

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the friction cones of contacts with less friction."""
        return friction_rows(self._narrowed(formulation), 0.0, 0.0, self.key)

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> None:
        """Return nothing: a cone alone bounds no force."""

    def loosened(self, share: float) -> Self:
        """Return it with `share` of what is left of the reserve given up."""
        return replace(self, given_up=self.given_up + share * (1 - self.given_up))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the slip margins that contacts with less friction would have; no less than 0 is asked of them."""
        margins = self._narrowed(formulation).response.grasp.slip_margins(motion.forces)
        return replace(FrictionCone(0.0).usage(formulation, motion), title=self.title, value=margins)

    def _narrowed(self, formulation: Formulation) -> Formulation:
        grasp = formulation.response.grasp
        contacts = tuple(
            replace(contact, kind=contact.kind.slippery(ratio))
            for contact, ratio in zip(grasp.contacts, self.used(grasp), strict=True)
        )
        return replace(formulation, response=replace(formulation.response, grasp=replace(grasp, contacts=contacts)))


def _ratios(grasp: Grasp, angle: float) -> Array:
    """Return the friction that is left when every contact force stays `angle` [rad] away from its cone."""
    left = np.arctan([contact.friction for contact in grasp.contacts]) - angle
    pairs = list(zip(grasp.contacts, left, strict=True))
    issues = [
        Issue(f"the friction cone of '{contact.name}' is only {np.degrees(angle + rest):.4g} deg wide; ask for less",
              key="FrictionReserve.angle")
        for contact, rest in pairs
        if contact.friction and rest <= 0
    ]  # fmt: skip
    raise_issues(issues)
    return frozen([np.tan(rest) / contact.friction if contact.friction else 1.0 for contact, rest in pairs])


_Angle = Annotated[float, Written(with_unit("angle", above=0), unit_schema("angle"))]
_Factor = Annotated[float, Written(lambda value: number(value, at_least=1), {"type": "number", "minimum": 1})]
ANGLE_IN_FILE = FileKey(
    "margin_angle", FrictionReserve, _Angle, "angle that every contact force keeps to its friction cone",
    lambda value, grasp: FrictionReserve(angle=value),
)  # fmt: skip
FACTOR_IN_FILE = FileKey(
    "safety_factor", FrictionReserve, _Factor,
    "factor by which friction may be smaller than stated before a contact slips",
    lambda value, grasp: FrictionReserve(factor=value),
)  # fmt: skip
