"""The smallest effort: sum of squared contact forces, or of squared joint torques."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from synergrip.conic.goals.goal import Objective
from synergrip.conic.rows import Rows
from synergrip.conic.situation import Situation


@dataclass(frozen=True)
class LeastEffort:
    """Minimise the sum over knots of ``||lambda||^2`` or ``||tau||^2`` (moments divided by the length of the grasp).

    Both determine the internal force: no internal force that the synergies control leaves all
    torques unchanged, since ``J' lambda = 0`` with ``lambda`` in E_s implies ``lambda = 0``.
    """

    of: Literal["contact", "torque"] = "contact"

    @property
    def name(self) -> str:
        """Name in messages."""
        return f"least {self.of} effort"

    def rows(self, situation: Situation) -> Sequence[Rows]:
        """Return none."""
        return ()

    def objective(self, situation: Situation) -> Objective:
        """Return the squares, in units of the force unit (times the length for torques)."""
        scale, unit = situation.response.scale, situation.force_unit
        if self.of == "contact":
            value = situation.force.after(np.diag(scale.force) / unit)
        else:
            value = situation.torque.after(np.eye(situation.response.grasp.n_q) / (unit * scale.length))
        return Objective(value.matrix.T @ value.matrix, value.constant @ value.matrix, None)
