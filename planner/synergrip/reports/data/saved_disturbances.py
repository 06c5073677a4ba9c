"""What a plan withstands, and the classical figures of its grasp, read again from a saved document."""

from __future__ import annotations

import numpy as np

from synergrip.margin.disturbance.disturbances import Disturbances, WithstoodAlong
from synergrip.margin.disturbance.executed_wrench import ExecutedWrench
from synergrip.margin.disturbance.withstood import Withstood
from synergrip.margin.wrench_space.quality import WrenchSpaceQuality
from synergrip.simulation.told_values import Told


def disturbances_of(told: Told) -> Disturbances:
    """Return what `disturbance_document` told.

    Raises:
        InputError: a value that is none.
    """
    norm = told.inside("norm")
    return Disturbances(
        _withstood(told.inside("passive_N")), _withstood(told.inside("slip_N")), _withstood(told.inside("active_N")),
        tuple(_along(each, "direction") for each in told.several("along")) if told.get("along") else (),
        None if told.get("box") is None else _along(told.inside("box"), "half_widths"),
        norm.number("length_m"), norm.array("centroid_m", (3,)), told.text("linear_model"),
        None if told.get("executed") is None else _executed(told.inside("executed")), tuple(told.texts("left_out")),
    )  # fmt: skip


def quality_of(told: Told) -> WrenchSpaceQuality:
    """Return what `quality_document` told.

    Raises:
        InputError: a value that is none.
    """
    return WrenchSpaceQuality(
        epsilon=_pair(told, "epsilon"), epsilon_synergies=_pair(told, "epsilon_synergies"),
        epsilon_pyramids=_pair(told, "epsilon_pyramids"), volume=_pair(told, "volume"),
        volume_synergies=_pair(told, "volume_synergies"), singular_values=told.array("singular_values", (None,)),
        singular_values_synergies=told.array("singular_values_synergies", (None,)), edges=int(told.number("edges")),
        length=told.number("length_m"), epsilon_each=told.perhaps("epsilon_each", _pair),
        epsilon_each_synergies=told.perhaps("epsilon_each_synergies", _pair), why=told.text("why"),
    )  # fmt: skip


def _pair(told: Told, name: str) -> tuple[float, float]:
    ends = told.inside(name)
    return ends.number("lower"), ends.number("upper")


def _along(told: Told, name: str) -> WithstoodAlong:
    parts = (_withstood(told.inside(part)) for part in ("passive", "slip", "active"))
    return WithstoodAlong(told.array(name, (6,)), told.text("unit"), *parts)


def _withstood(told: Told) -> Withstood:
    return Withstood(
        np.inf if told.get("lower") is None else told.number("lower"),
        told.perhaps("upper", Told.number), told.text("limit"), told.text("item"), told.perhaps("time_s", Told.number),
        told.perhaps("wrench", Told.array, (6,)), told.get("proven") is True,
    )  # fmt: skip


def _executed(told: Told) -> ExecutedWrench:
    return ExecutedWrench(
        told.array("wrench", (6,)), told.number("share"),
        told.perhaps("margin_N", Told.number), told.text("contact"),
        told.perhaps("time_s", Told.number), told.get("holds") is True, told.text("why"),
    )  # fmt: skip
