"""The goals of problem files by their names. A new goal is a line here."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from types import MappingProxyType

from synergrip.conic.goals.goal import Goal

FILES = (
    "largest_margin",
    "least_peak",
    "least_effort",
    "least_holding",
    "steady_forces",
    "least_motion",
    "centred_joints",
)
"""Modules beside this one, in the order in which messages list their goals."""

GOALS: Mapping[str, Goal] = MappingProxyType({
    name: goal
    for file in FILES
    for name, goal in import_module(f"synergrip.conic.goals.{file}").IN_FILE.items()
})  # fmt: skip
"""Goal by its name in a file."""
