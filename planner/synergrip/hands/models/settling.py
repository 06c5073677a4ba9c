"""Where joints go when actuators pull at them and springs hold them: the statics of an underactuated hand.

Actuators set y = R q, relations tie A q = b, and springs hold F q - g, with half the energy ||F q - g||^2. Motors are
stiff, so that without contact the joints settle where the energy is least; what a torque tau of the contacts adds is

    dq = -C tau,    C = N (N' K N)^-1 N',    K = F' F,    N = null([A; R]),

the yield of the motions that no actuator and no relation holds. A pull y moves the joints along the motions of
null(A) that are in balance without contact, N' K dq = 0. One motor on a tendon with arms r over joints with
compliances c_i alone: dq = (c r / r' c r) y, and C = c - c r r' c / (r' c r).

Motions of N that no spring holds are left open by this. Here joints yield alike in them, and only as far as the
problem says: dq has no part in them, and neither has C.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synergrip.hands.models.relations import Relations, clear_cut
from synergrip.linalg import Array, split

STILL = 1e-9
"""A joint whose row of an orthonormal basis is shorter does not move in it."""


@dataclass(frozen=True, eq=False)
class Springs:
    """Half the energy ||F q - g||^2."""

    F: Array
    """(n_s, n_q) root of the stiffness times the arm at each joint."""
    g: Array
    """(n_s,) F q with every spring at rest."""


@dataclass(frozen=True, eq=False)
class Settled:
    """How the joints of a hand move. Columns are motions, rows the joints."""

    rest: Array
    """(n_q,) where the joints are when nothing pulls and nothing touches [rad or m]."""
    free: Array
    """(n_q, f) orthonormal: what the relations allow."""
    driven: Array
    """(n_q, d) what the actuators do."""
    yielding: Array
    """(n_q, m) orthonormal: what neither an actuator nor a relation holds, N."""
    loose: Array
    """(n_q, o) orthonormal: what nothing holds, neither an actuator nor a relation nor a spring."""
    compliance: Array
    """(n_q, n_q) C of the springs [rad/(N m)]."""
    reached: tuple[bool, ...]
    """Whether an actuator moves the joint, or pushes at it."""

    @property
    def idle(self) -> tuple[bool, ...]:
        """Whether the joint could move, and no actuator moves it."""
        return tuple((moves(self.free) & ~np.array(self.reached, dtype=bool)).tolist())

    @property
    def relations(self) -> Relations | None:
        """What pulls and springs tie beside the given relations, idle joints left to themselves; None for nothing."""
        idle = np.array(self.idle, dtype=bool)
        alone = self.free @ split(self.free[~idle]).null_space if idle.any() else self.free[:, :0]
        moving = np.hstack([self.driven, alone])
        if moving.shape[1] == self.free.shape[1]:
            return None
        A = split(moving.T).null_space.T
        return Relations(A, A @ self.rest)


def moves(motions: Array) -> NDArray[np.bool_]:
    """Return (n_q,) which joints move in some of the `motions` (n_q, m)."""
    return np.asarray(np.linalg.norm(motions, axis=1) > STILL)


def settle(relations: Relations, pulls: Array, springs: Springs, q_0: Array) -> Settled:
    """Return how the joints move.

    Args:
        relations: A q = b, rows of norm 1 that do not contradict each other.
        pulls: (n_a, n_q) R, the joint torque per force of each actuator.
        springs: what else holds the joints.
        q_0: (n_q,) where the joints are in the motions that nothing holds.

    Raises:
        InputError: it depends on the last digits how many relations or pulls are independent.
    """
    free = split(relations.A).null_space
    lengths = np.linalg.norm(pulls, axis=1)
    unit = pulls[lengths > 0] / lengths[lengths > 0, None]
    taken = clear_cut(split(unit @ free, reference=1.0))
    W, N = free @ taken.row_space, free @ taken.null_space
    stiff = np.linalg.norm(springs.F, axis=1)
    held = split(springs.F[stiff > 0] / stiff[stiff > 0, None] @ N, reference=1.0)
    firm = N @ held.row_space
    Y = firm @ np.linalg.pinv(springs.F @ firm, rcond=1e-13)
    Y[~moves(N)] = 0.0  # not by rounding either
    p = relations.nearest(q_0)
    driven = W - Y @ (springs.F @ W)
    reached = moves(free @ free.T @ unit.T) | moves(driven)
    return Settled(
        p - Y @ (springs.F @ p - springs.g), free, driven, N, N @ held.null_space, Y @ Y.T, tuple(reached.tolist())
    )
