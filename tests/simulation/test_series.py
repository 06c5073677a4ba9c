"""What is kept of a play is what is told of it: the worst instants are among it, and it has no holes."""

from __future__ import annotations

import numpy as np
import pytest

import synergrip
from synergrip.simulation.keeping import SAMPLES, Kept, Row


@pytest.fixture(scope="module")
def lifted(tmp_path_factory: pytest.TempPathFactory) -> synergrip.Simulation:
    """Return a box lowered by a smooth step, which hardly moves near both ends."""
    problem = synergrip.load_problem("gripper-box", overrides=["task.move[0].lift=-9 mm", "task.knots=41"])
    answer = synergrip.plan(problem.grasp, problem.task)
    assert isinstance(answer, synergrip.Plan)
    return synergrip.simulate(answer, half_step=False)


def test_the_smallest_margins_are_in_the_series(lifted: synergrip.Simulation) -> None:
    for contact, (least, at) in enumerate(zip(lifted.least, lifted.least_at, strict=True)):
        margins = lifted.margin[:, contact]
        assert margins.min() == least
        assert lifted.time[np.argmin(margins)] == at
    assert lifted.margin.min() == lifted.worst[0]


def test_the_series_has_no_holes_on_the_clock_of_the_plan(lifted: synergrip.Simulation) -> None:
    gaps = np.diff(lifted.time)
    assert np.all(gaps >= 0)
    assert gaps.max() < 0.006 * (lifted.time[-1] - lifted.time[0]), "a part, and what goes by from one look to the next"
    assert len(lifted.time) < 3 * SAMPLES
    assert (lifted.time == lifted.time[-1]).sum() < 5, "what comes to rest at the end is one instant"


def row(at: float, margin: float) -> Row:
    return Row(
        at, np.zeros(3), np.array([margin]), np.zeros(1), np.zeros(1), np.array([True]), np.zeros(6), np.zeros(2)
    )


def test_instants_are_kept_by_both_clocks_and_the_worst_beside_them() -> None:
    kept, lower = Kept(1, 400.0, 4.0), np.array([True])
    kept.keep(0, 0.0, row(0.0, 2.0))
    assert not kept.due(0.5, 0.005)
    assert kept.due(1.0, 0.001), "the clock of the simulation has gone on"
    assert kept.due(0.1, 0.01), "that of the plan has"
    assert not kept.due(5.0, 0.0), "what comes to rest is where it was"
    kept.keep_worst(lower, 3, row(0.3, 1.0))
    kept.keep_worst(lower, 7, row(0.7, 0.5))
    kept.keep(9, 9.0, row(0.9, 1.5))
    at, _, margins, *_ = kept.columns()
    assert at.tolist() == [0.0, 0.7, 0.9]
    assert margins[:, 0].tolist() == [2.0, 0.5, 1.5]
