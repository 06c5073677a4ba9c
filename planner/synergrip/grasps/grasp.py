"""Where the hand touches the object: contacts, G and J. Equations (1)-(5) of the paper."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.grasps.contact import Contact
from synergrip.linalg import Array, block_diagonal, frozen


@dataclass(frozen=True)
class Grasp:
    """A grasp and all that its statics need, in SI units; contact rows (n, t, o [, moment about n])."""

    title: str
    contacts: tuple[Contact, ...]
    G: Array  # (6, n_l) grasp matrix about B, axes of N
    J: Array  # (n_l, n_q) hand Jacobian in the contact frames
    S: Array  # (n_q, n_z) synergy matrix
    C_s: Array  # (n_l, n_l) contact compliance [m/N]
    C_q: Array  # (n_q, n_q) joint compliance [rad/(N m)]
    C_z: Array  # (n_z, n_z) synergy compliance
    lambda_0: Array | None
    """(n_l,) contact forces at the start; None for the elastic reaction to w_0."""
    w_0: Array
    """(6,) external wrench on the object at the start."""
    joints: tuple[str, ...]
    synergies: tuple[str, ...]

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

    @property
    def rows(self) -> tuple[slice, ...]:
        """The rows of lambda that belong to each contact."""
        ends = np.cumsum([contact.n_rows for contact in self.contacts])
        return tuple(slice(int(end) - c.n_rows, int(end)) for end, c in zip(ends, self.contacts, strict=True))

    @property
    def normal_rows(self) -> list[int]:
        """The row of lambda that is the normal force of each contact."""
        return [rows.start for rows in self.rows]

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
    complete = [_to_contact_frame(c.frame) @ np.block([[np.eye(3), -_cross(c.point)], [np.zeros((3, 3)), np.eye(3)]])
                for c in contacts]  # fmt: skip
    return frozen((selection_matrix(contacts) @ np.vstack(complete)).T)


def hand_jacobian(contacts: Sequence[Contact], jacobians: Sequence[Array]) -> Array:
    """Return J (n_l, n_q): ``J = H J~`` of (5), from the (6, n_q) Jacobian of each contact point in palm axes."""
    complete = [_to_contact_frame(c.frame) @ j for c, j in zip(contacts, jacobians, strict=True)]
    return frozen(selection_matrix(contacts) @ np.vstack(complete))


def _to_contact_frame(frame: Array) -> Array:
    return block_diagonal([frame.T, frame.T])


def _cross(p: Array) -> Array:
    return np.array([[0.0, -p[2], p[1]], [p[2], 0.0, -p[0]], [-p[1], p[0], 0.0]])
