"""The wrenches of pyramids of friction, a second time: by trigonometry, sharing no formula with the planner."""

from __future__ import annotations

import numpy as np
from second_disturbances import unscaled

from synergrip.grasps.grasp import Grasp

EDGES = 8


def edge_wrenches(grasp: Grasp, edges: int) -> np.ndarray:
    """Zero and the wrenches of pyramids inside the cones of hard fingers, by trigonometry; no formula is shared."""
    found = [np.zeros(6)]
    inverse = np.linalg.inv(unscaled(grasp))
    for contact in grasp.contacts:
        n, t, o = contact.frame.T
        for angle in 2 * np.pi * np.arange(edges) / edges:
            force = n + contact.friction * (np.cos(angle) * t + np.sin(angle) * o)
            found.append(inverse @ np.concatenate([force, np.cross(contact.point, force)]))
    return np.array(found)
