"""A contact on its friction cone has not held; where margins are not those promised, the likely cause is told."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import synergrip
from synergrip.reports.data.simulation_files import simulation_document
from synergrip.reports.text.text_simulation import simulation_text
from synergrip.simulation.differences import Circumstances, allowed_difference, differences, likely_cause
from synergrip.simulation.played_plan import PlayedPlan, read_played_plan
from synergrip.simulation.watching import Watch, without_rounding


def test_what_stays_on_its_cone_has_not_held_however_little_it_crept(played: synergrip.Simulation) -> None:
    name, others = played.contacts[0], np.zeros(len(played.contacts) - 1)
    slip = np.linspace(0, 1, len(played.time))[:, None] * [4.2e-5, *others]
    least = np.array([0.0, *played.least[1:]])
    cone_at = np.array([[0.25, 0.75], *[[np.nan, np.nan]] * len(others)])
    crept = replace(played, slip=slip, least=least, on_cone=np.array([0.5, *others]), cone_at=cone_at)
    assert crept.at_cone == (name,)
    assert (crept.verdict, crept.exit_code) == ("at its cone", 3)
    text = " ".join(simulation_text(crept).split())
    assert f"at its cone {name} had no margin from 0.25 s to 0.75 s" in text
    assert "crept 0.042 mm" in text
    assert "held" not in text.rsplit("at its cone", 1)[1]
    told = simulation_document(crept)
    assert told["at_cone"] == [name]
    assert told["cone_at_s"] == [[0.25, 0.75], *[None] * len(others)]
    assert told["crept_m"][0] == pytest.approx(4.2e-5)
    json.dumps(told, allow_nan=False)
    moment = replace(crept, on_cone=np.array([0.01, *others]))
    assert (moment.verdict, moment.exit_code) == ("held", 0)
    assert f"at the cone for a moment: {name} for 10 ms" in " ".join(simulation_text(moment).split())


def test_a_watch_tells_how_long_and_when_margins_are_gone() -> None:
    watch, touching = Watch(2), np.array([True, True])
    for at, margin in ((0.0, 0.3), (0.1, 0.0), (0.2, 0.2), (0.3, 0.2), (0.4, 0.0), (0.5, 0.0), (0.6, 0.1), (0.7, 0.0)):
        watch.see(np.array([margin, 0.5]), touching, at, 0.015)
    assert watch.on_cone == pytest.approx([0.06, 0])
    assert watch.cone_at[0] == pytest.approx([0.4, 0.7])
    assert np.isnan(watch.cone_at[1]).all()
    assert watch.least == pytest.approx([0, 0.5])
    watch.see(np.zeros(2), np.array([False, False]), 0.8, 0.015)
    assert watch.on_cone == pytest.approx([0.06, 0]), "what does not touch is lost, not on its cone"
    told = [without_rounding(margin, np.array([3.0, 1.0])) for margin in (-2.2e-15, 3e-15, 1e-6, -1e-3)]
    assert [str(margin) for margin in told] == ["0.0", "0.0", "1e-06", "-0.001"]


def test_the_likely_cause_is_what_explains_most_of_a_difference(held: Path) -> None:
    plan = read_played_plan(held)
    promised = plan.margins.min(axis=0)
    least = promised - [allowed_difference(plan) + 0.01, 0.0]
    usual = Circumstances(1.0, "slow", 1e-4, ())
    assert differences(plan, promised) == ()
    assert likely_cause(plan, (), usual) is None
    found = differences(plan, least)
    assert [each.contact for each in found] == [plan.names[0]]

    def cause(plan: PlayedPlan = plan, **changed: Any) -> str:
        return str(likely_cause(plan, found, replace(usual, **changed)))

    assert "none is known" in cause()
    assert "friction was multiplied by 0.5" in cause(friction=0.5)
    assert "the step is too long" in cause(half_step=0.2)
    assert "inertia" in cause(speed="real")
    assert "from when left/tip slid" in cause(sliding=("left/tip",))
    assert "no true equilibrium" in cause(replace(plan, true_margins=None))
    assert "plan it along the motion" in cause(replace(plan, true_margins=plan.margins - 0.2))
    assert "do not roll" in cause(replace(plan, contact_model="fixed"))
