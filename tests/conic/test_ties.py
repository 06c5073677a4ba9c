"""Which of values that are as bad as each other is named, wherever it is told."""

from __future__ import annotations

import numpy as np

from synergrip.conic.limits.limit import Usage
from synergrip.conic.limits.ties import ALIKE, BROKEN, first_worst
from synergrip.margin.measures import Measure
from synergrip.reports.pictures.cone_sections import when_worst

TIMES = np.array([0.0, 0.4, 0.8])
NAMES = ("index", "ring")


def used(value: np.ndarray, scale: float = 0.72) -> Usage:
    lower, sizes = np.full(2, 0.3), np.full(2, scale)
    return Usage("slip margin", "N", NAMES, value, lower, np.full(2, np.inf), sizes, TIMES)


def test_margins_that_are_alike_as_shown_are_named_the_same_everywhere() -> None:
    """In plan, margins and cones: the first contact of the earliest knot, whatever the last digits are."""
    alike = 0.2999992 * (1 + np.array([[0.3, 0.3], [2.7e-6, 2.9e-6], [2.3e-6, 0.0]]))
    k, i = used(alike).worst()
    worst = Measure("slip margin", "N", "", alike, NAMES, TIMES).worst
    assert (NAMES[i], TIMES[k]) == (worst.name, worst.time_s) == ("index", 0.4)
    assert [when_worst(column) for column in alike.T] == [1, 1]
    told = 0.3 * (1 + np.array([[0.3, 0.3], [3 * ALIKE, 0.3], [0.3, 0.0]]))  # these differ in what is shown
    assert used(told).worst() == (2, 1)
    assert Measure("slip margin", "N", "", told, NAMES, TIMES).worst.name == "ring"


def test_what_is_broken_is_named_and_not_what_nearly_is() -> None:
    value = np.array([[0.4, 0.4], [0.3, 0.4], [0.3 - 1.2 * BROKEN, 0.4]])
    assert used(value, 1.0).worst() == (2, 0)


def test_a_contact_that_nothing_drags_at_does_not_hide_the_least_safety_factor() -> None:
    """Its factor is that of rounding, 1e15 or more."""
    factor = Measure("friction safety factor", "", "", np.array([[3e15, 15.0], [8.0, 2e14], [8.0, 9.0]]), NAMES, TIMES)
    assert (factor.worst.value, factor.worst.name, factor.worst.time_s) == (8.0, "index", 0.4)


def test_of_infinite_values_the_first_is_named() -> None:
    none = np.full((3, 2), np.inf)
    assert first_worst(-none, none) == (0, 0)
    assert first_worst(np.array([[0.1, 0.2], [np.inf, 0.3]]), np.array([[0.1, 0.2], [np.inf, 0.3]])) == (1, 0)
