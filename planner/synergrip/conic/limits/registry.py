"""The limits of problem files. A new limit is a line here."""

from __future__ import annotations

from synergrip.conic.limits import (
    actuator_effort,
    elastic_motion,
    friction_reserve,
    joint_range,
    joint_torque,
    normal_force,
    object_error,
    slip_margin,
    synergy_acceleration,
    synergy_rate,
    synergy_reference,
)
from synergrip.conic.limits.file_key import FileKey

LIMITS: tuple[FileKey, ...] = (
    slip_margin.IN_FILE,
    friction_reserve.ANGLE_IN_FILE,
    friction_reserve.FACTOR_IN_FILE,
    normal_force.IN_FILE,
    joint_torque.IN_FILE,
    actuator_effort.IN_FILE,
    synergy_reference.IN_FILE,
    synergy_rate.IN_FILE,
    synergy_acceleration.IN_FILE,
    joint_range.IN_FILE,
    elastic_motion.IN_FILE,
    object_error.IN_FILE,
)
"""In the order in which limits are listed, rows are stacked and messages name keys."""
