"""Loads and motions from CSV files with lines anywhere: what is claimed between the knots, judged at every line.

    python tests/judged_between.py [COUNT]

plans COUNT (500) random problems and prints what is wrong, and figures. Loads and motions are read here by themselves,
and forces follow from the statics of `elastic_grasp`.
"""

from __future__ import annotations

import sys
import tempfile
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from elastic_grasp import course, normal_forces, sizes_on

from synergrip.files import bundled
from synergrip.linalg import Array
from synergrip.planning.check import judge_references
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.planning.references import read_references
from synergrip.problems.problem import Problem, load_problem
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.data.plan_files import write_outcome

AXES = ("x", "y", "z", "rx", "ry", "rz")
CAP, MARGIN, TOLERANCE = 40.0, 0.2, 2e-3


@dataclass
class Judged:
    """What became of one problem."""

    seed: int
    verdict: str
    wrong: list[str] = field(default_factory=list)
    passed: bool = False
    """Whether limits are passed between the knots."""


def lines(rng: np.random.Generator, width: int, size: float) -> tuple[Array, Array]:
    """Return times (K,) from 0 to 1 and values (K, width) with a spike or two, the lines anywhere."""
    count = int(rng.integers(3, 60))
    times = np.concatenate([[0.0], np.sort(rng.uniform(0, 1, count)), [1.0]])
    if rng.uniform() < 0.5:  # lines that nearly meet, and some on the knots
        times[1:-1] = np.sort(np.round(times[1:-1], int(rng.integers(2, 7))))
    times = np.unique(times)
    values = np.cumsum(rng.normal(size=(len(times), width)), axis=0) * size / 8
    if rng.uniform() < 0.4:  # nothing happens for a while
        values[: len(times) // 2] = values[0]
    k = int(rng.integers(len(times)))
    values[k] += size * rng.normal(size=width)
    return times, values


def written(path: Path, header: str, times: Array, values: Array) -> None:
    rows = [",".join(map(repr, row)) for row in np.column_stack([times, values]).tolist()]
    path.write_text("\n".join([header, *rows]), encoding="utf-8")


@dataclass(frozen=True)
class Case:
    """A problem and its files, as they were written."""

    problem: Problem
    load: tuple[Array, Array]
    wish: tuple[Array, Array] | None
    folder: Path


def case(rng: np.random.Generator, folder: Path) -> Case:
    """Write a random problem on the tripod: held or moved along its rigid motions, to be reported or held."""
    times, forces = lines(rng, 3, rng.uniform(1, 6))
    load = np.hstack([forces - np.array([0, 0, 2.0]), 0.01 * rng.normal(size=(len(times), 3))])
    written(folder / "load.csv", "t_s,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm", times, load)
    wish, more = None, ""
    if rng.uniform() < 0.5:
        moves = lines(rng, 1, 1e-3)
        wish = moves[0], np.outer(moves[1] - moves[1][0], [0, 0, 1, 0, 0, 0])
        written(folder / "wish.csv", "t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad", *wish)
        more = "motion = 'wish.csv'\n"
        if rng.uniform() < 0.7:
            more += f"tracking = 'compliant'\ntolerance = '{1e3 * TOLERANCE} mm'\n"
    goal = rng.choice(["minimise = 'effort'", "minimise = 'peak_force'", "maximise = 'margin'"])
    text = f"""schema = 1
grasp = {{ file = '{bundled("problems") / "tripod.json"}' }}
[task]
duration = '1 s'
knots = {rng.integers(2, 12)}
between = '{rng.choice(["report", "hold"])}'
wrench = 'load.csv'
{more}
[limits]
margin = '{MARGIN} N'
normal_force = '{CAP} N'
[goal]
{goal}
"""
    (folder / "case.toml").write_text(text, encoding="utf-8")
    return Case(load_problem(folder / "case.toml"), (times, load), wish, folder)


def judged(seed: int) -> Judged:
    """Plan a random problem and judge what the answer says of the time between its knots."""
    with tempfile.TemporaryDirectory() as folder:
        found = case(np.random.default_rng(seed), Path(folder))
        outcome = plan(found.problem.grasp, found.problem.timed)
        if not isinstance(outcome, Plan):
            proven = outcome.verdict == "unknown" or outcome.certificate.verified
            return Judged(seed, outcome.verdict, [] if proven else ["not proven"])
        return _judged_plan(seed, found, outcome)


def _judged_plan(seed: int, found: Case, outcome: Plan) -> Judged:
    grasp, task, between = found.problem.grasp, found.problem.timed, outcome.between
    result = Judged(seed, "feasible")
    assert between is not None
    times = np.unique(np.concatenate([task.times, found.load[0], np.linspace(0, 1, 301), *(found.wish or ())[:1]]))
    wrench, dz_r, at_knots = (
        np.column_stack([np.interp(times, known, column) for column in values.T])
        for known, values in (found.load, (task.times, outcome.motion.dz_r), (task.times, task.wrench))
    )
    dense = course(grasp, times, dz_r, wrench)
    pairs = zip(grasp.contacts, grasp.rows, strict=True)  # a contact that pulls has a margin that its own formula gives
    margin = np.column_stack([contact.slip_margin(dense.forces[:, rows]) for contact, rows in pairs])
    normal = normal_forces(grasp, dense.forces)
    excess = max(MARGIN - margin.min(), normal.max() - CAP, -normal.min())
    if found.wish is not None and task.tracking == "compliant":
        wanted = np.column_stack([np.interp(times, found.wish[0], column) for column in found.wish[1].T])
        missed = sizes_on(grasp, AXES, dense.du - wanted).max() / TOLERANCE - 1
        excess = max(excess, missed)
    told = between.usages[0].value.min()
    if not between.exact:
        result.wrong.append("a load and a motion from files are not exact")
    if abs(told - margin.min()) > 1e-9 * np.abs(dense.forces).max():
        result.wrong.append(f"the margin falls to {margin.min()}, {told} told")
    away = np.linalg.norm(outcome.analysis.response.scale.wrench(wrench - at_knots), axis=1).max()
    if abs(between.load_departure - away) > 1e-8 * np.abs(wrench).max():
        result.wrong.append(f"the load departs by {away}, {between.load_departure} told")
    result.passed = bool(excess > 1e-4)
    if abs(excess) > 1e-4 and bool(between.excess > 1e-6) != bool(excess > 0):
        result.wrong.append(f"limits are passed by {excess}, {between.excess} told")
    if task.between == "hold" and excess > 1e-5:
        result.wrong.append(f"held, and passed by {excess}")
    write_outcome(found.folder, outcome_document("", grasp, outcome), outcome, ("json",))
    checked = judge_references(grasp, task, read_references(found.folder, grasp))
    if checked.verdict != "feasible" or checked.between is None:
        result.wrong.append(f"its own check fails: {[check.name for check in checked.checks if not check.passed]}")
    elif abs(checked.between.usages[0].value.min() - told) > 1e-9:
        result.wrong.append("check says another margin between the knots")
    return result


def main() -> None:
    """Judge many problems and print figures."""
    found = [judged(seed) for seed in range(int(sys.argv[1]) if len(sys.argv) > 1 else 500)]
    for each in found:
        for line in each.wrong:
            print(f"seed {each.seed}, {each.verdict}: {line}")
    print(
        dict(Counter(each.verdict for each in found)),
        f"limits passed between the knots in {sum(e.passed for e in found)}",
    )
    print(f"{sum(bool(each.wrong) for each in found)} wrong")


if __name__ == "__main__":
    main()
