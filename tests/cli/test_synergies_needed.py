"""The verb `synergies needed`: text, JSON, CSV and picture say the same; an interrupt keeps what is finished."""

from __future__ import annotations

import csv
from functools import partial
from pathlib import Path
from typing import Any

import command_line
import numpy as np
import pytest

from synergrip.explain.synergies import best_subsets
from synergrip.explain.synergies.subset_values import Tried
from synergrip.reports.pictures import needed_curve

run = partial(command_line.run, "synergies", "needed")
HELD = ("barrett-ball-hold", "--by", "effort")


@pytest.fixture(scope="module")
def document() -> dict[str, Any]:
    return command_line.document_of(run(*HELD, "--format", "json"), 0)


def test_the_document_has_a_point_for_each_number_of_synergies(document: dict[str, Any]) -> None:
    assert (document["set"], document["by"], document["model"]) == ("motors", "effort", "start")
    for points in (document["first"], document["best"]):
        assert [point["n_z"] for point in points] == [1, 2, 3, 4]
        assert all(len(point["synergies"]) == point["n_z"] for point in points)
    assert document["first"][-1]["effort_N"] == document["best"][-1]["effort_N"]
    assert document["fewest"] == len(document["minimal"][0])
    assert document["proven"]
    able = [point for point in document["best"] if point["verdict"] == "feasible"]
    assert able
    assert len(able) == 4 - document["fewest"] + 1
    assert all(np.diff([point["effort_N"] for point in able]) < 1e-6)  # more synergies never cost effort


def test_text_table_and_picture_are_of_the_same_points(
    document: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = list[Any]()
    monkeypatch.setattr(needed_curve, "write_picture", lambda *args: drawn.append(args))
    result = run(*HELD, "--csv", "needed.csv", "--picture", "needed.png")
    assert result.exit_code == 0
    assert "linear model of the start posture" in result.stdout
    assert f"fewest   {document['fewest']} of 4" in result.stdout
    assert result.stdout.endswith("wrote needed.csv\nwrote needed.png\n")
    with Path("needed.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [(row["chosen"], int(row["n_z"])) for row in rows] == [
        (c, n) for c in ("first", "best") for n in range(1, 5)
    ]
    for row, point in zip(rows, document["first"] + document["best"], strict=True):
        assert row["synergies"].split() == point["synergies"]
        assert row["verdict"] == point["verdict"]
        assert float(row["effort_N"] or "nan") == pytest.approx(point["effort_N"] or np.nan, nan_ok=True)
    assert [str(args[0]) for args in drawn] == ["needed.png"]


def test_the_picture_is_drawn() -> None:
    assert run("pinch-soft", "--picture", "needed.svg").exit_code == 0
    text = Path("needed.svg").read_text(encoding="utf-8")
    assert "largest slip margin [N]" in text
    assert "best k" in text


def test_an_interrupt_ends_with_130_and_shows_what_is_finished(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = best_subsets.Search.best

    def best(self: best_subsets.Search, size: int, smaller: Tried | None) -> best_subsets.Best:
        if size == 2:
            raise KeyboardInterrupt
        return whole(self, size, smaller)

    monkeypatch.setattr(best_subsets.Search, "best", best)
    document = command_line.document_of(run(*HELD, "--format", "json"), 130)
    assert document["interrupted"]
    assert [point["n_z"] for point in document["best"]] == [1]


@pytest.mark.parametrize(
    ("arguments", "fragment"),
    [
        (("barrett-ball-hold", "--up-to", "9"), "1 to 4, the number of synergies"),
        (("barrett-ball-hold", "--picture", "needed.xyz"), "says no format"),
        (("barrett-bal-hold",), "did you mean 'barrett-ball-hold'"),
        (("barrett-ball-hold", "--by", "speed"), "speed"),
    ],
)
def test_what_cannot_be_is_exit_code_2(arguments: tuple[str, ...], fragment: str) -> None:
    result = run(*arguments)
    assert result.exit_code == 2
    assert fragment in result.stderr


def test_where_no_synergies_do_that_is_certified() -> None:
    moved = ("barrett-ball-lift-joints", "--set", 'hand.synergies="motors"')
    found = command_line.document_of(run(*moved, "--format", "json"), 0)
    assert (found["verdict"], found["fewest"], found["proven"], found["minimal"]) == ("infeasible", None, True, [])
    assert [each["certified"] for each in found["refuted"]] == [4, 6, 4, 1]
    assert found["first"][0]["outside_m"] > 0.01
    part = command_line.document_of(run(*moved, "--up-to", "2", "--format", "json"), 0)
    assert part["verdict"] == "unknown"
    text = run(*moved).stdout
    assert "no: direction" in text
    assert "none: all together have no plan" in text
    assert "so these do not do" in " ".join(text.split())


def test_along_the_motion_the_figures_are_of_the_hand_that_moves() -> None:
    (once, along) = (
        command_line.document_of(run("gripper-box", *how, "--by", "effort", "--format", "json"), 0)["first"][-1]
        for how in ((), ("--along",))
    )
    assert once["verdict"] == along["verdict"] == "feasible"
    assert once["effort_N"] != along["effort_N"]
