"""Random grasps with synergies taken away: whether the contact motions that J S lost are named, and who has them.

    python tests/judged_missing.py [COUNT]

takes one or two columns from the S of COUNT (200) random grasps, asks for motions that only they allowed, and compares
what `missing_synergies` names with what was lost, modulo the range of what is left of J S. The comparison is one of
plain singular values.
"""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from random_grasps import random_grasp

from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.explain.synergies.missing_synergies import MissingSynergies, missing_synergies
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.other_synergies import chosen
from synergrip.hands.hand import SynergySet
from synergrip.linalg import Array, frozen
from synergrip.planning.outcome import Infeasible
from synergrip.planning.planning import plan
from synergrip.statics.analysis import analyse
from synergrip.tasks.timed_task import Target, TimedTask

FAR = 1e-6
"""Sine of the largest angle between spaces that are the same."""


@dataclass
class Case:
    """A grasp, what is left of it, and a motion that it could follow before."""

    whole: Grasp
    left: Grasp
    lost: Array
    """(n_q, k) columns of S that were taken away."""
    taken: SynergySet
    """The same by names, and a column of noise."""
    task: TimedTask


def moving_grasp(rng: np.random.Generator) -> Grasp:
    """Return a random grasp whose synergies move the object in one to three ways, mixed with others that do not."""
    motions = int(rng.integers(1, 4))
    kinds = [str(kind) for kind in rng.choice(["hard", "soft"], size=3)]
    n_l = sum(4 if kind == "soft" else 3 for kind in kinds)
    n_q = n_l + int(rng.integers(0, 3)) if rng.uniform() < 0.5 else motions + int(rng.integers(3, 6))
    n_z = motions + int(rng.integers(1, 4))
    grasp = random_grasp(rng, kinds, n_q=n_q, n_z=min(n_z, n_q))
    J, S = np.array(grasp.J), np.array(grasp.S)
    wanted = grasp.G.T @ (np.array([1, 1, 1, 20, 20, 20])[:, None] * rng.normal(size=(6, motions)))
    if n_q >= n_l:  # joints that can do anything: some synergies are made to carry the object
        S[:, :motions] = np.linalg.lstsq(J, wanted, rcond=None)[0]
    else:  # some joints carry the object, and have synergies of their own
        J[:, :motions] = wanted
        S[:, :motions] = np.eye(n_q)[:, :motions]
    mixed = S @ rng.normal(size=(S.shape[1], S.shape[1]))
    return replace(grasp, J=frozen(J), S=frozen(mixed / np.linalg.norm(mixed, axis=0)))


def case(rng: np.random.Generator) -> Case:
    """Return a grasp with columns taken away, and a motion in several directions that needs them."""
    whole = moving_grasp(rng)
    gone = rng.choice(whole.n_z, size=min(int(rng.integers(1, 3)), whole.n_z - 1), replace=False)
    left = chosen(whole, [i for i in range(whole.n_z) if i not in gone])
    free = analyse(whole).spaces.Gamma_ucs
    course = np.vstack([np.zeros(free.shape[1]), rng.normal(size=(4, free.shape[1]))])
    times = frozen(np.linspace(0, 1, len(course)))
    wish = Target("motion", frozen(1e-3 * course @ free.T))
    task = TimedTask(times, frozen(np.tile(whole.w_0, (len(times), 1))), wish, 0.0, (), (LeastEffort(),))
    names = (*(f"lost{i}" for i in range(len(gone))), "noise")
    taken = SynergySet(name="taken", synergies=names, S=np.column_stack([whole.S[:, gone], rng.normal(size=whole.n_q)]))
    return Case(whole, left, whole.S[:, gone], taken, task)


def beyond(columns: Array, reached: Array) -> Array:
    """Return an orthonormal basis of what columns (n, k) add to a range (n, m)."""
    basis = spanning(reached)
    left = columns - basis @ (basis.T @ columns)
    return spanning(left, float(np.linalg.norm(columns, 2)) if columns.size else 0.0)


def spanning(columns: Array, size: float | None = None) -> Array:
    """Return an orthonormal basis of a range."""
    vectors, values, _ = np.linalg.svd(columns, full_matrices=False)
    reference = values.max(initial=0.0) if size is None else size
    return np.asarray(vectors[:, values > 1e-7 * reference]) if reference > 0 else vectors[:, :0]


def wrong_with(case: Case, missing: MissingSynergies) -> str:
    """Return what is wrong with an answer; empty when all is right."""
    J, S = case.whole.J, case.left.S
    lost, named = beyond(J @ case.lost, J @ S), beyond(J @ missing.columns, J @ S)
    moves = analyse(case.whole).spaces.Gamma_ucs.shape[1] - analyse(case.left).spaces.Gamma_ucs.shape[1]
    if missing.count != moves or named.shape[1] != moves or not missing.proven:
        return f"{missing.count} named, {moves} motions lost"
    if np.linalg.norm(named - lost @ (lost.T @ named), 2) > FAR:
        return "what is named was not lost"
    again = replace(
        case.left, S=np.hstack([S, missing.columns]), C_z=0.0, synergies=[*case.left.synergies, *"abc"[:moves]]
    )
    u = case.task.target.values
    free = analyse(again).spaces.Gamma_ucs
    if np.abs(u - u @ np.linalg.pinv(free).T @ free.T).max() > 1e-9:
        return "with what is named the motion is not free"
    named_ones = {each.names for each in missing.candidates if each.set == "taken"}
    return "" if named_ones == who_has_it(case) else f"of those that were taken {named_ones} are named"


def who_has_it(case: Case) -> set[tuple[str, ...]]:
    """Return the smallest subsets of what was taken, and of the noise beside it, with which the motion is free."""
    J, wish = case.whole.J, case.whole.G.T @ case.task.target.values.T
    for size in range(1, len(case.taken.synergies) + 1):
        found = set()
        for picks in combinations(range(len(case.taken.synergies)), size):
            reached = spanning(J @ np.hstack([case.left.S, case.taken.S[:, picks]]))
            if np.abs(wish - reached @ (reached.T @ wish)).max() < 1e-9 * np.abs(wish).max() + 1e-12:
                found.add(tuple(case.taken.synergies[i] for i in picks))
        if found:
            return found
    return set()


def judged(seed: int) -> str | None:
    """Return what is wrong with one random case; None where the motion needs nothing of what was taken."""
    rng = np.random.default_rng(seed)
    made = case(rng)
    no = plan(made.left, made.task)
    if not isinstance(no, Infeasible) or no.stage not in ("direction", "count"):
        return None
    return wrong_with(made, missing_synergies(no, sets=(made.taken,), most=3))


def main(count: int) -> None:
    """Judge random cases and print what is wrong."""
    found, seed = Counter[str](), 0
    while found.total() < count:
        wrong = judged(seed)
        if wrong is not None:
            found[wrong or "right"] += 1
            if wrong:
                print(f"seed {seed}: {wrong}", flush=True)
        seed += 1
    print(dict(found), f"of {seed} grasps; {seed - count} needed nothing of what was taken")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 200)
