"""A simulation in the report of its plan: with the words of the command, of this very plan, and nothing else."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from dataclasses import replace
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import run

import synergrip
from synergrip.planning.digest import with_digest
from synergrip.reports.data.saved_simulation import saved_simulation, simulation_of
from synergrip.reports.data.simulation_files import simulation_document, write_simulation
from synergrip.reports.html.page import report_text
from synergrip.reports.html.physics import ADDED_BY, physics_of
from synergrip.reports.html.tables import in_folder
from synergrip.reports.text.text_simulation import contact_cells, how_played, sentences, simulation_text
from synergrip.simulation.differences import Difference

HOSTILE = ("<script>boom()</script>", '"><img src=x onerror=boom()>')


@pytest.fixture(scope="module")
def plan(held: Path) -> dict[str, Any]:
    return dict(json.loads((held / "plan.json").read_text(encoding="utf-8")))


@pytest.fixture(scope="module")
def dropped(played: synergrip.Simulation) -> synergrip.Simulation:
    """Return a play with all that may be told: contacts lost, at the cone, and apart from what was promised."""
    none = np.nan
    return replace(
        played, apart=np.array([0.1, 0.0]), lost_at=np.array([0.7, none]), slipped_at=np.array([none, none]),
        on_cone=np.array([0.0, 0.3]), cone_at=np.array([[none, none], [0.5, 0.8]]), ended=0.9, half_step=(0.1, none),
        differences=(Difference("left/tip", 0.0, 0.5),), likely_cause="less friction", notes=("noted",), friction=0.5,
    )  # fmt: skip


def test_what_was_saved_is_read_back(
    plan: dict[str, Any], played: synergrip.Simulation, dropped: synergrip.Simulation
) -> None:
    for simulation in (played, dropped, replace(played, true=None, true_worst=None, half_step=None)):
        document = json.loads(json.dumps(simulation_document(simulation)))
        again = simulation_of(document, plan)
        assert simulation_document(again) == document
        assert simulation_text(again) == simulation_text(simulation)
        for ours, theirs in zip(again.knots_promised, simulation.knots_promised, strict=True):
            assert np.array_equal(ours, theirs)


def test_the_report_has_the_words_of_the_command(
    tmp_path: Path, held: Path, plan: dict[str, Any], dropped: synergrip.Simulation
) -> None:
    assert dropped.plan_digest == plan["digest"]["sha256"]
    folder = tmp_path / "held"
    shutil.copytree(held, folder)
    write_simulation(folder, dropped)
    assert run("report", str(folder)).exit_code == 0
    text = unescape((folder / "report.html").read_text(encoding="utf-8"))
    part = text[text.index('<section id="physics">') : text.index('<section id="inputs">')]
    assert "all friction multiplied by 0.5" in how_played(dropped)
    said = [how_played(dropped), *(sentence for _, sentence in sentences(dropped))]
    cells = [cell for row in contact_cells(dropped)[1] for cell in row]
    assert [each for each in (*said, *cells) if each not in part] == []
    assert part.count("<svg") == 2
    assert "simulate FOLDER" not in part


def test_code_looks_in_the_folder_of_its_file(tmp_path: Path, played: synergrip.Simulation) -> None:
    problem = synergrip.load_problem("gripper-box", overrides=["task.move=[]", "task.knots=11"])
    answer = synergrip.plan(problem.grasp, problem.task)
    assert isinstance(answer, synergrip.Plan)
    answer.save(tmp_path, problem=problem)
    told = json.loads((tmp_path / "plan.json").read_text(encoding="utf-8"))
    few = replace(played, plan_digest=told["digest"]["sha256"])
    write_simulation(tmp_path, few)
    text = answer.report(tmp_path / "box.html", problem=problem).read_text(encoding="utf-8")
    assert how_played(few) in text


def _other(told: dict[str, Any]) -> dict[str, Any]:
    return with_digest(_without(told) | {"plan_sha256": "0" * 64})


def _without(told: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in told.items() if key != "digest"}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (_other, "is of another plan"),
        (lambda told: with_digest(_without(told) | {"plan_sha256": None}), "is of another plan"),
        (lambda told: told | {"friction_factor": 2.0}, "is not as it was written"),
        (_without, "does not say of which plan it is"),
        (lambda told: with_digest(_without(told) | {"slip_m": "none"}), "cannot be read"),
        (lambda told: with_digest(_without(told) | {"lost_at_s": [None]}), "cannot be read"),
        (lambda told: with_digest(_without(told) | {"contacts": [*told["contacts"], "one more"]}), "cannot be read"),
        (lambda told: told | {"title": "\ud800"}, "cannot be read: a text in it is none"),
        (lambda told: [], "cannot be read"),
    ],
)
def test_what_is_no_simulation_of_this_plan_is_left_out_and_told(
    tmp_path: Path, plan: dict[str, Any], played: synergrip.Simulation, change: Callable[[Any], Any], said: str
) -> None:
    told = change(simulation_document(played))
    (tmp_path / "simulation.json").write_text(json.dumps(told), encoding="utf-8")
    (table,) = physics_of(plan, tmp_path)
    assert not table.rows
    assert not table.drawn
    assert f"simulation.json beside it {said}" in table.before[0]
    assert ADDED_BY in table.before[-1]


def test_without_a_simulation_the_command_that_adds_it_is_told_where_a_plan_can_be_played(
    tmp_path: Path, plan: dict[str, Any]
) -> None:
    assert saved_simulation(tmp_path, plan) is None
    for beside in (tmp_path, None):
        (table,) = physics_of(plan, beside)
        assert table.before == (f"{in_folder(ADDED_BY, None)}.",)
    bare = plan["execution"] | {"object": plan["execution"]["object"] | {"shape": None}}
    for other in (plan | {"verdict": "infeasible"}, plan | {"execution": bare}, {"verdict": "feasible"}):
        assert list(physics_of(other, tmp_path)) == []


def test_hostile_names_and_notes_stay_text(tmp_path: Path, plan: dict[str, Any], dropped: synergrip.Simulation) -> None:
    named = replace(
        dropped, contacts=HOSTILE, notes=HOSTILE, likely_cause=HOSTILE[0], differences=(Difference(HOSTILE[1], 0, 1),)
    )  # fmt: skip
    write_simulation(tmp_path, named)
    text = report_text(plan, beside=tmp_path)
    part = text[text.index('<section id="physics">') : text.index('<section id="inputs">')]
    assert unescape(part).count("boom()") >= 6
    assert "<script" not in part
    assert "<img" not in part
