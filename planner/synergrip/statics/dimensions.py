"""What the first K synergies control, for every K, with hard and with soft contacts. Equation (34), row by row.

The dimensions depend on no compliance (docs/theory.md), so the contacts are taken as equally stiff in every
direction and everything else as rigid: the rank decisions are then as clear-cut as the kinematics lets them be.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.contacts.soft_finger import SoftFinger
from synergrip.grasps.grasp import Grasp, grasp_matrix, hand_jacobian
from synergrip.grasps.other_synergies import chosen
from synergrip.grasps.placing import moved_to
from synergrip.grasps.scale import scale_of
from synergrip.linalg import Array, frozen
from synergrip.statics import respond, subspaces
from synergrip.statics.restraint import told_as_free


@dataclass(frozen=True)
class Dimensions:
    """Of the controlled subspaces; their sum is n_z (34)."""

    E_s: int
    Gamma_ucs: int
    Gamma_zr: int
    ambiguous: bool
    """True when a rank decision behind them lies in the grey zone."""


@dataclass(frozen=True)
class DimensionColumn:
    """The dimensions with every contact of one kind."""

    kind: str
    """"hard" or "soft"."""
    rows: tuple[Dimensions, ...]
    """For the first 1, 2, ... n_z synergies; empty when there is a reason."""
    reason: str
    """Why there are none; else empty."""
    free: str = ""
    """What the object may do that such contacts do not resist, if anything; the dimensions are those of the rest."""


def dimension_table(grasp: Grasp) -> tuple[DimensionColumn, DimensionColumn]:
    """Return the dimensions for the first K synergies of a grasp, every contact taken as hard, then as soft.

    A grasp given as matrices has only the rows of J that it has: soft contacts become hard by leaving the spin out,
    the other way there is nothing to go by.
    """
    hard, soft = (
        _column(grasp, kind) for kind in (HardFinger(friction=1.0), SoftFinger(friction=1.0, spin_friction=1.0))
    )
    return hard, soft


def _column(whole: Grasp, kind: ContactKind) -> DimensionColumn:
    grasp = with_kind(whole, kind)
    if grasp is None:
        lacking = "moments about the normals" if kind.name == "soft" else "forces across the normals"
        return DimensionColumn(kind.name, (), f"the matrices do not say how the contacts transmit {lacking}")
    rows = tuple(_dimensions(chosen(grasp, range(count))) for count in range(1, grasp.n_z + 1))
    response = respond(grasp)
    return DimensionColumn(kind.name, rows, "", told_as_free(grasp, response.scale, response.free_twists))


def with_kind(grasp: Grasp, kind: ContactKind) -> Grasp | None:
    """Return a grasp with every contact of one `kind`; None when its matrices do not hold it.

    Compliances are those of the module's head, and friction is of no account: the grasp is good for dimensions only.
    """
    if any(set(kind.components) - set(contact.kind.components) for contact in grasp.contacts):
        changed = _reformed(grasp, kind)
        if changed is None:
            return None
    else:
        changed = _reduced(grasp, kind)
    stiffness = scale_of(changed).force
    n_q, n_z = changed.n_q, changed.n_z
    return replace(
        changed, C_s=frozen(np.diag(stiffness**2)), C_q=frozen(np.zeros((n_q, n_q))), C_z=frozen(np.zeros((n_z, n_z))),
        lambda_0=None, w_0=frozen(np.zeros(6)),
    )  # fmt: skip


def _reduced(grasp: Grasp, kind: ContactKind) -> Grasp:
    """Return the grasp with those force components only that the `kind` has; all contacts have them."""
    kept = [i for i, (_, component) in enumerate(grasp.components) if component in kind.components]
    contacts = tuple(replace(contact, kind=kind) for contact in grasp.contacts)
    return _with(grasp, contacts, frozen(grasp.G[:, kept]), frozen(grasp.J[kept]))


def _reformed(grasp: Grasp, kind: ContactKind) -> Grasp | None:
    """Return the grasp formed anew from the motion of the links, G and J of (5); None without a hand."""
    held = grasp.held
    if held is None:
        return None
    contacts: tuple[Contact, ...] = tuple(replace(contact, kind=kind) for contact in grasp.contacts)
    motions = held.hand.kinematics.at(held.q, [(touch.pad.link, touch.pad.point) for touch in held.touches])
    places = [contact.point + held.body.position for contact in contacts]
    moved = [moved_to(motion, place).jacobian for motion, place in zip(motions, places, strict=True)]
    return _with(grasp, contacts, grasp_matrix(contacts), hand_jacobian(contacts, moved))


def _with(grasp: Grasp, contacts: tuple[Contact, ...], G: Array, J: Array) -> Grasp:
    """Return the grasp with other force components, whose stiffness is for the caller to say."""
    return replace(grasp, contacts=contacts, G=G, J=J, C_s=frozen(np.eye(G.shape[1])), lambda_0=None)


def _dimensions(grasp: Grasp) -> Dimensions:
    spaces = subspaces(respond(grasp))
    # the force map is here the very matrix of "rigid", so its own decision can say no more than that one
    decided = (spaces.decisions[name] for name in ("restraint", "redundancy", "rigid"))
    return Dimensions(*spaces.dimensions, any(decision.ambiguous for decision in decided))
