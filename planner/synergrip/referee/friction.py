"""What each kind of contact can hold, written by hand (docs/theory.md) and not from its cone matrices."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from synergrip.conic.rows import Item
from synergrip.errors import InputError, Issue
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.friction_cones import cone_unit
from synergrip.referee.model import Cone, Expression

Parts = Iterator[tuple[str, float, Expression]]
"""For each cone of a contact: what it is about, the factor of the normal force, and what that must be larger than."""


class NotWrittenError(InputError):
    """A limit, goal or contact kind for which the second formulation has no formula."""

    @classmethod
    def of(cls, what: str, value: object) -> NotWrittenError:
        """Return the error for a limit, goal or kind, which the other solver takes all the same."""
        name = type(value).__name__
        advice = "use solver 'clarabel' (--solver clarabel), or write its formula in referee/"
        return cls([Issue(f"the CVXPY formulation knows no {what} {name}; {advice}", "solver")])


def contact_cones(contact: Contact, force: Expression, margin: Expression, share: float, key: str) -> Iterator[Cone]:
    """Yield ``slip margin >= margin`` of one contact, for all of its cones.

    Args:
        contact: the contact.
        force: (T, rows) its forces in force units.
        margin: in force units.
        share: of its friction that may be used.
        key: what asks for it.

    Raises:
        NotWrittenError: there is no formula for its kind.
    """
    name = contact.kind.name
    if name not in FORMULAS:
        raise NotWrittenError.of("contact kind", contact.kind)
    for side, factor, tail in FORMULAS[name](contact.kind, force, share):
        own, item = cone_unit(factor), (Item(contact.name, side),)
        head = factor * force[:, :1] - margin
        yield Cone(key, item, head) if tail is None else Cone(key, item, head[:, 0] / own, tail / own)


def _frictionless(kind: Any, force: Expression, share: float) -> Parts:
    """``n >= 0``."""
    yield "", 1.0, None


def _hard(kind: Any, force: Expression, share: float) -> Parts:
    """``mu n >= ||(t, o)||``."""
    yield "", share * kind.friction, force[:, 1:]


def _soft(kind: Any, force: Expression, share: float) -> Parts:
    """``mu n >= sqrt(t^2 + o^2 + (mu m / nu)^2)``."""
    mu, nu = share * kind.friction, share * kind.spin_friction
    yield "", mu, force[:, 1:] @ np.diag([1.0, 1.0, mu / nu])


def _soft_elliptic(kind: Any, force: Expression, share: float) -> Parts:
    """``mu n >= mu sqrt((t / mu_t)^2 + (o / mu_o)^2 + (m / nu)^2)``, mu the smaller of mu_t and mu_o."""
    axes = share * np.array([kind.friction, kind.cross_friction, kind.spin_friction])
    mu = float(min(axes[:2]))
    yield "", mu, force[:, 1:] @ np.diag(mu / axes)


def _patch(kind: Any, force: Expression, share: float) -> Parts:
    """``mu n >= sqrt(t^2 + o^2 + (mu m / nu)^2)``, and ``n >= ||(m_t, m_o)|| / r``."""
    mu, nu = share * kind.friction, share * kind.spin_friction
    yield "slip", mu, force[:, 1:4] @ np.diag([1.0, 1.0, mu / nu])
    yield "tipping", 1.0, force[:, 4:] / kind.patch_radius


FORMULAS: dict[str, Callable[[Any, Expression, float], Parts]] = {
    "frictionless": _frictionless,
    "hard": _hard,
    "soft": _soft,
    "soft-elliptic": _soft_elliptic,
    "patch": _patch,
}
"""By the name of the kind."""
