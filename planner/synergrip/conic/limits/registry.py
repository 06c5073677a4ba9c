"""The limits of problem files. A new limit is a line here."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module

from synergrip.conic.limits.file_key import FileKey

FILES = (
    "slip_margin",
    "friction_reserve",
    "normal_force",
    "joint_torque",
    "actuator_effort",
    "sustained_torque",
    "sustained_effort",
    "synergy_reference",
    "synergy_rate",
    "synergy_acceleration",
    "joint_range",
    "elastic_motion",
    "object_error",
)
"""Modules beside this one, in the order in which limits are listed, rows are stacked and messages name keys."""


def _keys() -> Iterator[FileKey]:
    """Yield what the files may say of limits, in the order in which each module states its keys."""
    for name in FILES:
        held = vars(import_module(f"synergrip.conic.limits.{name}")).values()
        yield from (each for each in held if isinstance(each, FileKey))


LIMITS: tuple[FileKey, ...] = tuple(_keys())
