"""What is told of limits: words that are true of the value beside them."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from synergrip.conic.limits.usage import Usage
from synergrip.linalg import frozen
from synergrip.problems.in_short import asked_in_short
from synergrip.problems.problem import load_problem
from synergrip.reports.pictures.lines import Lines
from synergrip.reports.pictures.plan_picture import draw_charts
from synergrip.reports.text.text_usages import STAR, as_little, worst_of


def usage(title: str, values: list[float], lower: list[float], upper: list[float]) -> Usage:
    ends = np.array([lower, upper])
    items = tuple(f"i{k}" for k in range(len(values)))
    low, high, half = (frozen(each) for each in (ends[0], ends[1], np.ptp(ends, axis=0) / 2))
    return Usage(title, "N", items, frozen([values]), low, high, half, frozen([0.0]))


def test_the_value_nearest_its_own_end_is_not_called_the_largest() -> None:
    """Of 0.9 of 1 and 2 of 10 the first is nearest to its end, and not the largest."""
    (upper, lower) = worst_of(usage("joint value", [0.9, 2.0], [0.0, -10.0], [1.0, 10.0]))
    assert (upper[0], upper[1], upper[2]) == ("joint nearest upper end", "0.9 N", "i0")
    assert (lower[0], lower[2]) == ("joint nearest lower end", "i1")
    same = [row[0] for row in worst_of(usage("force", [0.5, 0.7], [0.0, 0.0], [1.0, 1.0]))]
    assert same == ["largest force", "smallest force"]


@pytest.mark.parametrize(("value", "marked"), [(2.9, True), (3.0, False), (3.1, False)])
def test_a_value_beyond_a_limit_that_counts_as_kept_is_marked(value: float, marked: bool) -> None:
    of = usage("slip margin", [value], [3.0], [9.0])
    assert [row[-1].endswith(STAR) for row in worst_of(of, mark=STAR)] == [False, marked]
    assert not any(STAR in row[-1] for row in worst_of(of))


def test_contacts_that_are_as_near_to_slipping_are_counted() -> None:
    margins = np.array([[0.3, 0.30001, 0.5], [0.4, 0.3, 0.3000004]])
    assert as_little(margins) == ", and as little at 2 other contacts"
    assert as_little(margins[:1, [0, 2]]) == ""


@pytest.mark.parametrize(("name", "told"), [
    ("barrett-ball-carry", "the palm turns 90 deg about x and shifts 400 mm, with inertia"),
    ("barrett-ball-arm", "the palm goes up to 669 mm and 84 deg from its start, on a path, with inertia"),
    ("human-ball-near", None),
])  # fmt: skip
def test_how_the_palm_moves_is_told(name: str, told: str | None) -> None:
    asked = [*asked_in_short(load_problem(name).timed)]
    assert [each for each in asked if each.startswith("the palm")] == ([told] if told else [])


def test_a_chart_of_margins_shows_0_so_that_a_blip_is_no_jump(tmp_path: Path) -> None:
    lines = Lines("slip margin", "N", ("a",), 0.3 + np.array([[0.0], [0.002], [0.0]]), (0.3,), of_contacts=True)
    for sign in (1, -1):
        draw_charts(
            [replace(lines, values=sign * lines.values, bounds=())], np.arange(3.0), "", "", tmp_path / "slip.svg"
        )
        drawn = (tmp_path / "slip.svg").read_text(encoding="utf-8")
        assert f">{'−' * (sign < 0)}0.10</text>" in drawn
        assert "0.301" not in drawn


def test_a_contact_is_told_with_its_units() -> None:
    html = load_problem("pinch-soft")._repr_html_()
    assert "spin friction 0.0" not in html
    assert re.search(r"spin friction [\d.]+ mm", html)
