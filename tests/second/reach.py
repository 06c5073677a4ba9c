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
BEST = 3
"""How many of the postures that do for contacts which stay where they are become those of contacts that roll."""
FIRM = 1e-5
"""[m] Contacts are as dear to the search as joints beyond their ranges by as many [rad]."""


@dataclass(frozen=True)
class Found:
    """The best posture that was found."""

    apart: float  # [m] of the worst contact
    beyond: float  # [rad], [m] of the joint farthest beyond its range

    @property
    def short(self) -> float:
        """What is missing, of which postures are compared [m], [rad]."""
        return self.apart + max(self.beyond - BEYOND, 0.0)

    @property
    def reached(self) -> bool:
        """Whether the hand gets there."""
        return self.apart <= APART and self.beyond <= BEYOND


class Search:
    """A hand that holds an object, from the `execution` of a plan.json."""

    def __init__(self, block: dict[str, Any], tree: Tree) -> None:
        """Take posture, contacts and ranges; from where contacts are fixed to where they roll it is not far."""
        self.fixed, self.rolling = (Equilibrium(block, tree, model) for model in ("fixed", "rolling"))
        lower, upper = np.array(block["joint_range"], dtype=float).T
        self.lower, self.upper = np.where(np.isnan(lower), -np.inf, lower), np.where(np.isnan(upper), np.inf, upper)

    def to(self, pose: Array, seed: int = 0, starts: int = 20) -> Found:
        """Look for a posture in which the object is displaced by a pose (6,), translation and rotation vector.

        Args:
            pose: [m, rad]
            seed: of the starts.
            starts: how many to begin at; the first is the posture at the start. The best few are gone on with.
        """
        rng, n_z = np.random.default_rng(seed), self.fixed.S.shape[1]
        near = self._nearest(np.zeros(n_z), pose)
        best = self._rolled(near.x, pose)
        if best.reached:
            return best
        fixed = [near, *(self._nearest(self._anywhere(rng), pose) for _ in range(starts - 1))]
        for nearest in sorted(fixed, key=lambda each: float(each.cost))[:BEST]:
            best = min(best, self._rolled(nearest.x, pose), key=lambda found: found.short)
            if best.reached:
                break
        return best

    def _nearest(self, z: Array, pose: Array) -> Any:
        """Return what the search comes to from references (n_z,), with contacts that stay where they are."""
        return least_squares(self._residual, z, self._slope, args=(pose, self.fixed), max_nfev=40)

    def _rolled(self, z: Array, pose: Array) -> Found:
        """Return what it goes on to from there, with contacts that roll."""
        z = least_squares(self._residual, z, self._slope, args=(pose, self.rolling), max_nfev=15).x
        apart, beyond = self._off(z[None], pose, self.rolling)
        return Found(float(np.linalg.norm(apart[0], axis=-1).max()), float(beyond.max(initial=0.0)))

    def _anywhere(self, rng: np.random.Generator) -> Array:
        """Return references (n_z,) whose joints are near random places in their ranges."""
        free = np.isfinite(self.lower) & np.isfinite(self.upper)
        low, high = (np.where(free, end, self.fixed.q_0) for end in (self.lower, self.upper))
        wanted = low + rng.random(len(low)) * (high - low) - self.fixed.q_0
        return np.linalg.lstsq(self.fixed.S, rng.uniform(0.2, 1.0) * wanted, rcond=None)[0]

    def _residual(self, z: Array, pose: Array, hand: Equilibrium) -> Array:
        apart, beyond = self._off(z[None], pose, hand)
        return np.concatenate([apart[0].ravel() / FIRM, 1e-2 * beyond[0] / FIRM])

    def _slope(self, z: Array, pose: Array, hand: Equilibrium) -> Array:
        trial = np.vstack([z, z + DIFFERENCE * np.eye(len(z))])
        apart, beyond = self._off(trial, pose, hand)
        rows = np.hstack([apart.reshape(len(trial), -1) / FIRM, 1e-2 * beyond / FIRM])
        return np.asarray((rows[1:] - rows[0]).T / DIFFERENCE)

    def _off(self, z: Array, pose: Array, hand: Equilibrium) -> tuple[Array, Array]:
        """Return how far contacts are apart (B, n_c, 3) and joints beyond their ranges (B, n_q), for references."""
        q = hand.q_0 + z @ hand.S.T
        links = hand.tree.poses(q).links
        p = np.tile(hand.p_0 + pose[:3], (len(z), 1))
        R = np.tile(Rotation.from_rotvec(np.array(pose[3:])).as_matrix(), (len(z), 1, 1))
        each = zip(hand.touching, hand.contacts, hand.start.settled, strict=True)
        seen = [touch.stretched(links[contact["link"]], p, R, settled) for touch, contact, settled in each]
        apart = np.stack([contact.stretch[:, :3] for contact in seen], axis=1)
        return apart, np.maximum(np.maximum(self.lower - q, q - self.upper), 0.0)
