"""Whether a hand can bring its object to a pose at all: many starts of nonlinear least squares, no planner.

Unknown are the references; joints follow them (stiffly), each contact has to be where it is fixed, or where its tip has
rolled to by then, and joints stay in their ranges. Forces are not asked for.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation
from second.equilibrium import Equilibrium
from second.tree import Tree

Array = np.ndarray

APART = 6e-4
"""[m] What contacts may be apart: as much as a motion may miss its pose; springs and loads take part of it, too."""
BEYOND = 2e-3
"""[rad], [m] How far joints may be beyond their ranges."""
DIFFERENCE = 1e-7
FIRM = 1e-5
"""[m] Contacts are as dear to the search as joints beyond their ranges by as many [rad]."""


@dataclass(frozen=True)
class Found:
    """The best posture that was found."""

    apart: float  # [m] of the worst contact
    beyond: float  # [rad], [m] of the joint farthest beyond its range
    starts: int  # how many there were until then

    @property
    def reached(self) -> bool:
        """Whether the hand gets there."""
        return self.apart <= APART and self.beyond <= BEYOND


class Search:
    """A hand that holds an object, from the `execution` of a plan.json."""

    def __init__(self, block: dict[str, Any], tree: Tree, model: str = "rolling") -> None:
        """Take posture, contacts and ranges."""
        self.hand = Equilibrium(block, tree, model)
        ends = [
            [-np.inf if low is None else low, np.inf if high is None else high] for low, high in block["joint_range"]
        ]
        self.lower, self.upper = np.array(ends).T

    def to(self, pose: Array, seed: int = 0, starts: int = 30, known: Array | None = None) -> Found:
        """Look for a posture in which the object is displaced by a pose (6,), translation and rotation vector.

        Args:
            pose: [m, rad]
            seed: of the starts.
            starts: how many to try at most; the first is the posture at the start.
            known: references (n_z,) to begin with, too.
        """
        rng, n_z = np.random.default_rng(seed), self.hand.S.shape[1]
        begin = [np.zeros(n_z), *([] if known is None else [known])]
        best = Found(np.inf, np.inf, 0)
        for count in range(1, starts + 1):
            z = begin[count - 1] if count <= len(begin) else self._anywhere(rng)
            z = self._solved(z, pose)
            apart, beyond = self._off(z[None], pose)
            worst = Found(float(np.linalg.norm(apart[0], axis=-1).max()), float(beyond.max(initial=0.0)), count)
            if worst.apart + max(worst.beyond - BEYOND, 0) < best.apart + max(best.beyond - BEYOND, 0):
                best = worst
            if best.reached:
                break
        return best

    def _anywhere(self, rng: np.random.Generator) -> Array:
        """Return references (n_z,) whose joints are near random places in their ranges."""
        free = np.isfinite(self.lower) & np.isfinite(self.upper)
        low, high = (np.where(free, end, self.hand.q_0) for end in (self.lower, self.upper))
        wanted = low + rng.random(len(low)) * (high - low) - self.hand.q_0
        return np.linalg.lstsq(self.hand.S, rng.uniform(0.2, 1.0) * wanted, rcond=None)[0]

    def _solved(self, z: Array, pose: Array) -> Array:
        """Return the references (n_z,) that least squares end with, the path followed in one stride."""
        return np.asarray(least_squares(self._residual, z, self._slope, args=(pose,), max_nfev=60).x)

    def _residual(self, z: Array, pose: Array) -> Array:
        apart, beyond = self._off(z[None], pose)
        return np.concatenate([apart[0].ravel() / FIRM, 1e-2 * beyond[0] / FIRM])

    def _slope(self, z: Array, pose: Array) -> Array:
        trial = np.vstack([z, z + DIFFERENCE * np.eye(len(z))])
        apart, beyond = self._off(trial, pose)
        rows = np.hstack([apart.reshape(len(trial), -1) / FIRM, 1e-2 * beyond / FIRM])
        return np.asarray((rows[1:] - rows[0]).T / DIFFERENCE)

    def _off(self, z: Array, pose: Array) -> tuple[Array, Array]:
        """Return how far contacts are apart (B, n_c, 3) and joints beyond their ranges (B, n_q), for references."""
        q = self.hand.q_0 + z @ self.hand.S.T
        links = self.hand.tree.poses(q).links
        p = np.tile(self.hand.p_0 + pose[:3], (len(z), 1))
        R = np.tile(Rotation.from_rotvec(pose[3:]).as_matrix(), (len(z), 1, 1))
        each = zip(self.hand.touching, self.hand.contacts, self.hand.start.settled, strict=True)
        seen = [touch.stretched(links[contact["link"]], p, R, settled) for touch, contact, settled in each]
        apart = np.stack([contact.stretch[:, :3] for contact in seen], axis=1)
        return apart, np.maximum(np.maximum(self.lower - q, q - self.upper), 0.0)
