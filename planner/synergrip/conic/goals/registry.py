"""The goals of problem files by their names. A new goal is a line here."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from synergrip.conic.goals import centred_joints, largest_margin, least_effort, least_motion, least_peak, steady_forces
from synergrip.conic.goals.goal import Goal

GOALS: Mapping[str, Goal] = MappingProxyType({
    **largest_margin.IN_FILE,
    **least_peak.IN_FILE,
    **least_effort.IN_FILE,
    **steady_forces.IN_FILE,
    **least_motion.IN_FILE,
    **centred_joints.IN_FILE,
})  # fmt: skip
"""Goal by its name in a file, in the order in which messages list them."""
