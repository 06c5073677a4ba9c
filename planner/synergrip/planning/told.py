"""What is told of a plan, as plain values: the same words for those who write it and for those who check it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from synergrip.conic.limits.limit import Usage
from synergrip.grasps.contacts.kind import is_moment
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.planning.between import Between
from synergrip.planning.outcome import Check
from synergrip.planning.verified import LIMIT
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion

AXES = ("x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad")


def arrays_of(motion: Motion, parts: tuple[Array, Array, Array], rigid_basis: Array) -> dict[str, Array]:
    """Return what a motion is at its knots, by the keys of plan.json.

    Args:
        motion: what the references do.
        parts: their alpha, beta and gamma.
        rigid_basis: (6, dim Gamma_ucs).
    """
    alpha, beta, gamma = parts
    return {
        "dz_r": motion.dz_r, "alpha": alpha, "beta": beta, "gamma": gamma, "lambda": motion.forces,
        "wrench": motion.wrench, "du": motion.du, "dq": motion.dq, "tau": motion.torques, "sigma": motion.efforts,
        "elastic_motion": motion.du - motion.sag - beta @ rigid_basis.T, "sag": motion.sag,
    }  # fmt: skip


def columns_of(grasp: Grasp) -> dict[str, tuple[str, ...]]:
    """Return the columns of plan.csv by the keys of plan.json; those of "margin" hold its `per_contact_N`."""
    found = {
        "dz_r": tuple(f"zr_{i + 1}" for i in range(grasp.n_z)),
        "lambda": tuple(f"lambda_{name}_{c}" + ("_Nm" if is_moment(c) else "_N") for name, c in grasp.components),
        "tau": tuple(f"tau_{name}" for name in grasp.joints),
        "du": tuple(f"du_{axis}" for axis in AXES),
        "margin": tuple(f"margin_{contact.name}_N" for contact in grasp.contacts),
    }
    return {key: tuple(map(_one_line, names)) for key, names in found.items()}


def _one_line(name: str) -> str:
    """Return the name of a column without control characters, which a model file may hold."""
    return "".join(letter if letter.isprintable() else "?" for letter in name)


def structure_document(grasp: Grasp, analysis: Analysis | None) -> dict[str, Any]:
    """Return the counts and dimensions; the dimensions are null when the object is not restrained."""
    counts: dict[str, Any] = {"n_c": grasp.n_c, "n_l": grasp.n_l, "n_q": grasp.n_q, "n_z": grasp.n_z}
    if analysis is None:
        unknown = ("dim_E_s", "dim_Gamma_ucs", "dim_Gamma_zr", "singular_values", "ambiguous")
        return counts | dict.fromkeys(unknown)
    forces, motions, redundant = analysis.spaces.dimensions
    decisions = analysis.spaces.decisions
    return counts | {
        "dim_E_s": forces, "dim_Gamma_ucs": motions, "dim_Gamma_zr": redundant,
        "singular_values": {name: decision.singular_values.tolist() for name, decision in decisions.items()},
        "ambiguous": analysis.spaces.ambiguous,
        "characteristic_length_m": analysis.response.scale.length,
    }  # fmt: skip


def check_document(check: Check) -> dict[str, Any]:
    """Return a check with its outcome."""
    return {"name": check.name, "error": finite(check.error), "tolerance": check.tolerance, "passed": check.passed}


def margin_document(margins: Usage) -> dict[str, Any]:
    """Return the worst slip margin, where and when (the first of those that differ by rounding), and all of them."""
    k, i = margins.worst()
    return {
        "worst_N": float(margins.value.min()), "contact": margins.items[i], "time_s": float(margins.times[k]),
        "per_contact_N": margins.value.tolist(),
    }  # fmt: skip


def usage_document(usage: Usage) -> dict[str, Any]:
    """Return the worst value of a limit, where and when, and its bounds there."""
    k, i = usage.worst()
    return {
        "name": usage.title, "unit": usage.unit, "item": usage.items[i], "time_s": float(usage.times[k]),
        "value": float(usage.value[k, i]), "lower": finite(usage.lower[i]), "upper": finite(usage.upper[i]),
    }  # fmt: skip


def between_document(between: Between | None) -> dict[str, Any] | None:
    """Return what was looked at between the knots, how far load and wish bend there, and the worst of every limit."""
    if between is None:
        return None
    return {
        "samples": between.samples, "corners_s": list(between.corners), "exact": between.exact,
        "load_departure_N": between.load_departure, "path_departure_m": between.path_departure,
        "holds": bool(between.excess <= LIMIT), "limits": [usage_document(usage) for usage in between.usages],
        "worst_margin_N": float(between.usages[0].value.min()),
    }  # fmt: skip


def finite(value: float) -> float | None:
    """Return a number, or None for what JSON has no word for."""
    return float(value) if math.isfinite(value) else None


def table_of(motion: Motion, margins: Array) -> Array:
    """Return the lines (T, ...) of plan.csv: times, and then the columns of `columns_of` one after the other."""
    return np.column_stack([motion.times, motion.dz_r, motion.forces, motion.torques, motion.du, margins])
