"""A grasp with something changed: friction, the kind of a contact, the mass of the object, a compliance."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

import numpy as np

from synergrip.documents.judging import Arguments, described, is_number
from synergrip.errors import InputError, one_of
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.grasp import Grasp, grasp_matrix, hand_jacobian
from synergrip.grasps.placing import Touch, moved_to
from synergrip.linalg import block_diagonal


def varied(
    grasp: Grasp, *, friction: float | None, contact: Mapping[str, ContactKind] | None, mass: float | None,
    others: Mapping[str, Any],
) -> Grasp:  # fmt: skip
    """Return a grasp with something changed, as `Grasp.replace` says.

    Raises:
        InputError: an unknown name, a value that is none, a mass where there is no object, a kind of other components
            than the matrices have.
    """
    known = [field.name for field in fields(Grasp) if field.name not in ("held", "contacts", "factors")]
    for name in others:
        if name not in known:
            raise InputError.at(name, one_of(name, ["friction", "contact", "mass", *known]), on_key=True)
    changed = _with_kinds(grasp, _kinds(grasp, friction, {} if contact is None else contact))
    changed = replace(changed, **others)
    if changed.held is None:
        if mass is not None:
            raise InputError.at(
                "mass", "this grasp is given as matrices, and has no object; change the load of the task"
            )
        return changed
    held = replace(changed.held, C_q=changed.C_q)
    if mass is not None:
        held = replace(held, body=replace(held.body, mass=mass))
    return replace(changed, held=held)


def _kinds(grasp: Grasp, friction: float | None, wish: Mapping[str, ContactKind]) -> list[ContactKind]:
    judge, names = Arguments(""), grasp.contact_names
    if not isinstance(wish, Mapping):
        raise InputError.at("contact", f"expected kinds by name of contact such as {{{names[0]!r}: HardFinger(...)}}")
    for name, kind in wish.items():
        if name not in names:
            judge.refuse(f"contact[{name!r}]", one_of(name, names))
        else:
            judge.one(f"contact[{name!r}]", kind, ContactKind, "HardFinger(friction=0.6)")
    if friction is not None:
        each = "; give contacts their own by contact={" + f"{names[0]!r}: HardFinger(friction=0.6)" + "}"
        if not is_number(friction):
            judge.refuse("friction", f"expected one number for all contacts, got {described(friction)}{each}")
            judge.finish()
        friction = judge.number("friction", friction, above=0)
    judge.finish()
    common = [c.kind if friction is None else c.kind.with_friction(friction) for c in grasp.contacts]
    return [wish.get(name, kind) for name, kind in zip(names, common, strict=True)]


def _with_kinds(grasp: Grasp, kinds: list[ContactKind]) -> Grasp:
    """Return the grasp with other kinds; new rows of G, J and C_s where their components differ."""
    contacts = tuple(replace(contact, kind=kind) for contact, kind in zip(grasp.contacts, kinds, strict=True))
    held = grasp.held
    if held is not None:
        touches = tuple(replace(touch, kind=kind) for touch, kind in zip(held.touches, kinds, strict=True))
        grasp = replace(grasp, held=replace(held, touches=touches))
    if all(new.kind.components == old.kind.components for new, old in zip(contacts, grasp.contacts, strict=True)):
        return replace(grasp, contacts=contacts)
    if held is None:
        return _fewer(grasp, contacts)
    motions = held.hand.kinematics.at(held.q, [(touch.pad.link, touch.pad.point) for touch in touches])
    spots = [contact.point + held.body.position for contact in contacts]
    jacobians = [moved_to(motion, spot).jacobian for motion, spot in zip(motions, spots, strict=True)]
    blocks = [_block(grasp, i, touch) for i, touch in enumerate(touches)]
    return replace(
        grasp, contacts=contacts, G=grasp_matrix(contacts), J=hand_jacobian(contacts, jacobians),
        C_s=block_diagonal(blocks), lambda_0=None,
    )  # fmt: skip


def _block(grasp: Grasp, index: int, touch: Touch) -> np.ndarray:
    """Return the compliance of a contact: as it is where the components stay, else from its entries of stiffness."""
    rows, old = grasp.rows[index], grasp.contacts[index].kind.components
    if touch.kind.components == old:
        return grasp.C_s[rows, rows]
    if missing := [name for name in touch.kind.stiffnesses() if name not in touch.stiffness]:
        message = (
            f"a {touch.kind.name} contact needs {' and '.join(missing)}, which contact '{touch.name}' has not; make "
            "the grasp anew with it"
        )
        raise InputError.at(f"contact[{touch.name!r}]", message)
    return touch.kind.compliance(touch.stiffness)


def _fewer(grasp: Grasp, contacts: tuple[Contact, ...]) -> Grasp:
    """Return a grasp given as matrices with some rows left out, or refuse kinds that need more of them."""
    kept = []
    for old, new, rows in zip(grasp.contacts, contacts, grasp.rows, strict=True):
        if more := [component for component in new.kind.components if component not in old.kind.components]:
            message = f"the matrices say nothing of {' and '.join(more)} of this {old.kind.name} contact"
            raise InputError.at(f"contact[{new.name!r}]", message)
        kept += [rows.start + i for i, each in enumerate(old.kind.components) if each in new.kind.components]
    return replace(
        grasp, contacts=contacts, G=grasp.G[:, kept], J=grasp.J[kept], C_s=grasp.C_s[np.ix_(kept, kept)], lambda_0=None
    )
