"""Where the hand touches the object: contacts, G and J. Equations (1)-(5) of the paper."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.factors import Factors
from synergrip.grasps.friction_cones import Cones, cones_of, slip_margins
from synergrip.grasps.grasp_judging import Judge
from synergrip.grasps.matrix_reading import unbalanced
from synergrip.linalg import Array, block_diagonal, frozen
from synergrip.values import ByContent
from synergrip.vectors import skews

if TYPE_CHECKING:
    from synergrip.grasps.held import Held

MOST_SHOWN = 6
"""Contacts that a repr names."""


@naming_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Grasp(ByContent):
    """A grasp and all that its statics need, in SI units; contact rows (n, t, o [, moments about them]).

    `make_grasp` and `grasp_from_matrices` make one. A number in the place of a compliance stands for that times the
    identity, as in a grasp file.

    Example:
        >>> grasp.n_l, grasp.n_q, grasp.n_z, [contact.name for contact in grasp.contacts]
        (9, 8, 4, ['finger1/tip', 'finger2/tip', 'finger3/tip'])
        >>> grasp.replace(friction=0.4).contacts[0].friction
        0.4
    """

    title: str = ""
    contacts: tuple[Contact, ...]
    G: Array  # (6, n_l) grasp matrix about B, axes of N
    J: Array  # (n_l, n_q) hand Jacobian in the contact frames
    S: Array  # (n_q, n_z) synergy matrix
    C_s: Array  # (n_l, n_l) contact compliance [m/N]
    C_q: Array = 0.0  # type: ignore[assignment]  # (n_q, n_q) joint compliance [rad/(N m)]
    C_z: Array = 0.0  # type: ignore[assignment]  # (n_z, n_z) synergy compliance
    lambda_0: Array | None = None
    """(n_l,) contact forces at the start; None for the elastic reaction to w_0."""
    w_0: Array = field(default_factory=lambda: frozen(np.zeros(6)))
    """(6,) external wrench on the object at the start: -G lambda_0 where lambda_0 is given."""
    joints: tuple[str, ...]
    synergies: tuple[str, ...]
    held: Held | None = None
    """The hand in its posture, and the object; None for a grasp given as matrices."""
    factors: Factors = field(default_factory=Factors, compare=False)
    """By what a problem file has multiplied friction and stiffness; they are in the numbers already."""

    def __post_init__(self) -> None:
        """Judge the values as those of a grasp file; a number as a compliance stands for that times the identity.

        Raises:
            InputError: contacts that are none, shapes that do not fit each other, numbers that are not finite, names
                that stand twice, forces at the start that w_0 contradicts.
        """
        judge = Judge("Grasp")
        contacts = judge.several("contacts", self.contacts, Contact, "Contact(...)")
        if not judge.issues and not contacts:
            judge.refuse("contacts", "expected at least one contact")
        judge.finish()  # all that follows goes by their components
        n_l = sum(contact.n_rows for contact in contacts)
        if self.held is not None:
            from synergrip.grasps.held import Held

            judge.one("held", self.held, Held, "that of make_grasp(...)")
        judge.names("contacts", [contact.name for contact in contacts])
        G, J, S = judge.kinematics(self.G, self.J, self.S, n_l)
        kept: dict[str, object] = {
            "title": judge.text("title", self.title), "contacts": contacts, "G": G, "J": J, "S": S,
            "C_s": judge.compliance("C_s", self.C_s, n_l),
            "lambda_0": None if self.lambda_0 is None else judge.array("lambda_0", self.lambda_0, (n_l,)),
            "w_0": judge.array("w_0", self.w_0, (6,)),
        }  # fmt: skip
        judge.finish()  # what follows goes by the sizes of J and S
        kept |= {
            "C_q": judge.compliance("C_q", self.C_q, J.shape[1]),
            "C_z": judge.compliance("C_z", self.C_z, S.shape[1]),
            "joints": judge.named("joints", self.joints, J.shape[1], "joint"),
            "synergies": judge.named("synergies", self.synergies, S.shape[1], "synergy"),
        }
        start, load = kept["lambda_0"], np.asarray(kept["w_0"])
        if not judge.issues and start is not None and (message := unbalanced(G, np.asarray(start), load)):
            judge.refuse("w_0", f"{message}; give w_0 = -G @ lambda_0, or leave lambda_0 out")
        judge.finish()
        for name, value in kept.items():
            object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        """Return title, contacts and sizes, in one line."""
        contacts = ", ".join(f"{contact.name} ({contact.kind.name})" for contact in self.contacts[:MOST_SHOWN])
        more = f" and {self.n_c - MOST_SHOWN} more" if self.n_c > MOST_SHOWN else ""
        sizes = f"n_l x n_q x n_z = {self.n_l} x {self.n_q} x {self.n_z}"
        return f"<Grasp{f' {self.title!r}' if self.title else ''}: contacts {contacts}{more}; {sizes}>"

    @naming_arguments
    def replace(
        self,
        *,
        friction: float | None = None,
        contact: Mapping[str, ContactKind] | None = None,
        mass: float | None = None,
        **others: Any,
    ) -> Grasp:
        """Return the grasp with something changed.

        Args:
            friction: coefficient of friction of all contacts that have one.
            contact: the kind of some contacts, by name.
            mass: of the object [kg].
            **others: ``title``, ``C_s``, ``C_q``, ``C_z``, ``w_0``, ``lambda_0``, ``S`` and other fields.

        Raises:
            InputError: a name or value that is none, a mass where there is no object, a kind of other components than
                the matrices have.

        Example:
            >>> slippery = grasp.replace(friction=0.3, contact={"thumb": HardFinger(friction=0.6)})  # doctest: +SKIP
        """
        from synergrip.grasps.variations import varied

        return varied(self, friction=friction, contact=contact, mass=mass, others=others)

    @property
    def n_c(self) -> int:
        """Number of contacts."""
        return len(self.contacts)

    @property
    def n_l(self) -> int:
        """Number of contact-force components."""
        return int(self.G.shape[1])

    @property
    def n_q(self) -> int:
        """Number of joints."""
        return int(self.J.shape[1])

    @property
    def n_z(self) -> int:
        """Number of synergies."""
        return int(self.S.shape[1])

    @cached_property
    def rows(self) -> tuple[slice, ...]:
        """The rows of lambda that belong to each contact."""
        ends = np.cumsum([contact.n_rows for contact in self.contacts])
        return tuple(slice(int(end) - c.n_rows, int(end)) for end, c in zip(ends, self.contacts, strict=True))

    @cached_property
    def normal_rows(self) -> list[int]:
        """The row of lambda that is the normal force of each contact."""
        return [rows.start for rows in self.rows]

    @cached_property
    def friction_cones(self) -> tuple[Cones, ...]:
        """The friction cones of all contacts, those of one size together."""
        return cones_of(self.contacts, self.rows)

    @cached_property
    def least_cone_unit(self) -> float:
        """The smallest of what the friction cones are divided by: the least friction, where there is little."""
        return min(float(cones.unit.min()) for cones in self.friction_cones)

    @cached_property
    def contact_names(self) -> tuple[str, ...]:
        """The names of the contacts."""
        return tuple(contact.name for contact in self.contacts)

    def slip_margins(self, forces: Array) -> Array:
        """Return the slip margins (T, n_c) [N] of contact forces (T, n_l), as `Contact.slip_margin` says of each."""
        return slip_margins(self.friction_cones, forces[:, self.normal_rows], forces)

    @property
    def components(self) -> tuple[tuple[str, str], ...]:
        """(contact name, component) of each row of lambda."""
        return tuple((c.name, component) for c in self.contacts for component in c.kind.components)


def selection_matrix(contacts: Sequence[Contact]) -> Array:
    """Return H (n_l, 6 n_c) of (3), in the contact frames."""
    return block_diagonal([contact.kind.selection for contact in contacts])


def grasp_matrix(contacts: Sequence[Contact]) -> Array:
    """Return G (6, n_l): ``G' = H G~'`` of (5), wrenches about the origin of B.

    The contact twist of an object that moves with (v, omega) about B is
    ``R' (v + omega x p)``, ``R' omega`` with R = (n, t, o).
    """
    complete = [_to_contact_frame(c.frame) @ np.block([[np.eye(3), -skews(c.point)], [np.zeros((3, 3)), np.eye(3)]])
                for c in contacts]  # fmt: skip
    return frozen((selection_matrix(contacts) @ np.vstack(complete)).T)


def hand_jacobian(contacts: Sequence[Contact], jacobians: Sequence[Array]) -> Array:
    """Return J (n_l, n_q): ``J = H J~`` of (5), from the (6, n_q) Jacobian of each contact point in palm axes."""
    complete = [_to_contact_frame(c.frame) @ j for c, j in zip(contacts, jacobians, strict=True)]
    return frozen(selection_matrix(contacts) @ np.vstack(complete))


def _to_contact_frame(frame: Array) -> Array:
    return block_diagonal([frame.T, frame.T])
