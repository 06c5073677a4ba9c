"""A grip that fails is told with when and why, also before anything moves; a file that was changed is told as that."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import document, run

import synergrip
from synergrip.planning.digest import KEY, with_digest
from synergrip.reports.pictures.simulation_picture import draw_simulation
from synergrip.reports.text.text_simulation import became, simulation_text
from synergrip.simulation.watching import Watch


def loosened(held: Path, folder: Path, written: bool) -> Path:
    """Return a copy of a plan whose references hardly squeeze; with the digest of that when it is to be `written`."""
    data: dict[str, Any] = json.loads((held / "plan.json").read_text())
    data["dz_r"] = (0.05 * np.array(data["dz_r"])).tolist()
    if written:
        data = with_digest({key: value for key, value in data.items() if key != KEY})
    folder.mkdir()
    (folder / "plan.json").write_text(json.dumps(data))
    return folder


@pytest.fixture(scope="module")
def dropped(held: Path, tmp_path_factory: pytest.TempPathFactory) -> synergrip.Simulation:
    folder = loosened(held, tmp_path_factory.mktemp("dropped") / "plan", written=False)
    return synergrip.simulate(folder, half_step=False, speed="real")


def test_what_falls_before_the_start_is_told_as_that(dropped: synergrip.Simulation) -> None:
    assert dropped.verdict in ("lost contact", "slipped")
    assert dropped.exit_code == 3
    assert dropped.failed_before
    assert dropped.failed_at is not None
    assert dropped.ended is not None
    assert dropped.failed_at < dropped.ended < dropped.knots[0] == 0
    assert dropped.time[-1] == dropped.ended
    assert np.all(np.diff(dropped.time) > 0)
    assert dropped.least_at.max() < 0
    assert np.linalg.norm(dropped.du[0, :3]) < 2e-3, "where the play is first shown nothing has fallen yet"
    assert 0.05 < np.linalg.norm(dropped.du[-1, :3]) < 0.06, "nor is it shown on a way that nobody follows"
    text = " ".join(simulation_text(dropped).split())
    assert "s before the start, as pads stuck no longer and before anything moved" in text
    assert "inertia, " not in text


def test_a_slip_before_the_start_and_a_loss_after_it_are_told_with_their_own_times(
    played: synergrip.Simulation,
) -> None:
    lost = np.arange(len(played.contacts)) == 0
    later = replace(played, apart=np.where(lost, 1.0, 0.0), lost_at=np.where(lost, 0.8133, np.nan))
    first = f"no touch at {played.contacts[0]}, first at 0.8133 s"
    assert became(later) == first
    slipped = replace(later, slip=np.full_like(played.slip, 1e-3), slipped_at=np.where(lost, np.nan, -0.1))
    assert slipped.failed_before
    loose = "as pads stuck no longer and before anything moved"
    assert became(slipped) == f"{first}; the object slipped 0.1 s before the start, {loose}"


def test_a_changed_file_promises_nothing(held: Path, dropped: synergrip.Simulation) -> None:
    assert json.loads((held / "plan.json").read_text())["true"] is not None
    text = " ".join(simulation_text(dropped).split())
    assert dropped.as_written is False
    assert dropped.plan_digest is None, "nobody may take it for a play of the plan that was written"
    assert dropped.true is None
    assert dropped.true_worst is None
    assert "plan.json is not as it was written" in str(dropped.likely_cause)
    assert "note plan.json is not as it was written (its digest is another)" in text
    assert "N claimed" in text
    assert "promised" not in text
    assert "at the true equilibrium" not in text


def test_references_that_do_not_hold_at_the_start_are_told_as_the_cause(held: Path, tmp_path: Path) -> None:
    found = document("simulate", str(loosened(held, tmp_path / "plan", written=True)), "--speed", "real", "--once",
                     code=3)  # fmt: skip
    assert found["as_written"] is True
    assert found["failed_at_s"] < found["ended_at_s"] < 0
    assert "references of the start do not hold" in found["differs"]["likely_cause"]
    gone = [at for at in found["lost_at_s"] + found["slipped_at_s"] if at is not None]
    assert min(gone) == found["failed_at_s"]


def test_the_picture_shows_the_fall_beside_the_whole_promise(
    dropped: synergrip.Simulation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[Any] = []
    monkeypatch.setattr("synergrip.reports.pictures.simulation_picture.draw_charts", lambda *given: drawn.append(given))
    draw_simulation(dropped, tmp_path / "dropped.svg")
    (parts, times, _, under, _), = drawn  # fmt: skip
    assert set(dropped.knots.tolist()) <= set(times.tolist())
    assert "before the start" in under
    assert "claimed" in under
    motion = next(chart for chart in parts if chart.title == "object displacement")
    assert np.isnan(motion.values[times > dropped.ended]).all()
    assert np.isfinite(motion.values[times <= dropped.ended]).all()
    assert np.isfinite(motion.target).all()
    monkeypatch.undo()
    draw_simulation(dropped, tmp_path / "dropped.svg")
    assert (tmp_path / "dropped.svg").read_text().startswith("<?xml")


def test_what_holds_is_as_written_and_has_not_failed(played: synergrip.Simulation) -> None:
    assert played.as_written is True
    assert (played.failed_at, played.failed_before, played.ended) == (None, False, None)
    assert (played.time[0], played.time[-1]) == (played.knots[0], played.knots[-1])
    assert np.isnan(played.lost_at).all()
    elsewhere = replace(played, ended=0.5)
    assert (elsewhere.verdict, elsewhere.exit_code) == ("went elsewhere", 3), "what was not played to its end"


def test_a_watch_tells_since_when_contacts_are_gone() -> None:
    watch, both, one = Watch(2), np.array([True, True]), np.array([False, True])
    for number, touching in enumerate([both, one, both, both, one, one, one, one]):
        watch.see(np.zeros(2), touching, 0.1 * number, 0.002)
        watch.slid(np.array([0.0, 2e-5 * number]), np.zeros(2), 0.1 * number)
    assert watch.lost_at[0] == pytest.approx(0.4), "when it parted, not when that had lasted for long enough"
    assert np.isnan(watch.lost_at[1])
    assert watch.slipped_at[1] == pytest.approx(0.3)
    assert np.isnan(watch.slipped_at[0])
    assert watch.afresh().lost_at[0] == watch.lost_at[0]
    watch.see(np.zeros(2), both, 1.0, 0.002)
    assert np.isnan(watch.afresh().lost_at[0]), "what touches again when the plan begins is not lost"


def test_shares_are_told_by_tenths_where_there_is_no_terminal(held: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("synergrip.cli.progress.PATIENCE", 0.0)
    told = run("simulate", str(held), "--speed", "real", "--once").stderr.splitlines()
    assert told[0] == "playing at 0.0002 s a step ..."
    assert told[-1] == "playing at 0.0002 s a step ... 90%"
    assert len(told) == 10
    monkeypatch.setattr("synergrip.cli.progress.PATIENCE", 1e3)
    assert len(run("simulate", str(held), "--speed", "real", "--once").stderr.splitlines()) == 1, "nor when it is short"
