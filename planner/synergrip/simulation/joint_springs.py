"""How the joints hold: stiff where something gives, prescribed where nothing does.

Joints stand at q - q_r = -C (tau - tau_0), with C = C_q + S C_z S' and q_r = q_0 + S dz_r. In the range of C that is a
spring, tau = tau_0 - K (q - q_r) with K the inverse of C there; in its null space q is q_r, whatever is carried.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.values import Value

NOTHING = 1e-9
"""Share of the largest compliance below which a direction does not give."""


@dataclass(frozen=True, eq=False, repr=False)
class JointSprings(Value):
    """The springs of the joints."""

    K: Array  # (n_q, n_q) [N m/rad], 0 on what is prescribed
    held: Array  # (n_q, n_q) projector on what gives
    prescribed: Array  # (n_q, n_q) projector on what does not

    @cached_property
    def count(self) -> int:
        """How many directions are prescribed."""
        return round(float(np.trace(self.prescribed)))


def joint_springs(C: Array) -> JointSprings:
    """Return the springs of joints with a compliance (n_q, n_q), symmetric and positive semidefinite."""
    values, vectors = np.linalg.eigh((C + C.T) / 2)
    gives = values > NOTHING * max(float(values.max(initial=0.0)), 1e-300)
    U = vectors[:, gives]
    held = U @ U.T
    return JointSprings(frozen(U / values[gives] @ U.T), frozen(held), frozen(np.eye(len(C)) - held))
