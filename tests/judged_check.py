"""Every number that a plan.json claims, altered by a share of itself: does `check` reject it?

    python tests/judged_check.py [MOST [PROBLEM ...]]

alters MOST (100) numbers of every key of the plans of some bundled problems and prints what was not rejected, once by
the comparisons with the references alone, once with the digest of the file as well.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from synergrip.errors import SynergripError
from synergrip.planning.check import judge_references
from synergrip.planning.digest import unchanged
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.planning.references import references_of
from synergrip.problems.problem import Problem, load_problem
from synergrip.reports.data.json_plan import outcome_document

SHARE = 0.05
UNCLAIMED = {"seconds", "primal_residual", "dual_residual", "error", "gap", "iterations", "attempts", "digest"}
"""Residuals, and how the solver went about it."""
NAMES = ("tripod", "pinch-soft", "barrett-ball-hold", "gripper-peg", "human-ball-near", "robonaut-handle-knock")

Path = tuple[str | int, ...]


@dataclass
class Altered:
    """What became of the altered numbers of a plan."""

    count: int = 0
    missed: list[tuple[str, float]] = field(default_factory=list)
    """Key and value of those that the file's digest and the comparisons both accept."""
    compared: list[tuple[str, float]] = field(default_factory=list)
    """Those that the comparisons alone accept."""


def numbers(value: Any, path: Path = ()) -> Iterator[tuple[Path, float]]:
    """Yield every number of a document that is claimed and not zero, with the way to it."""
    if isinstance(value, dict):
        for key, each in value.items():
            if key not in UNCLAIMED:
                yield from numbers(each, (*path, key))
    elif isinstance(value, list):
        for i, each in enumerate(value):
            yield from numbers(each, (*path, i))
    elif isinstance(value, int | float) and not isinstance(value, bool) and value != 0:
        yield path, value


def document_of(problem: Problem) -> dict[str, Any]:
    """Return the plan of a problem as it is written."""
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    found = json.loads(json.dumps(outcome_document(problem.title, problem.grasp, outcome, problem.notes)))
    assert isinstance(found, dict)
    return found


def altered(document: dict[str, Any], path: Path, value: float) -> dict[str, Any]:
    """Return a copy of a document with one number in another's place."""
    copy = json.loads(json.dumps(document))
    place = copy
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = value
    assert isinstance(copy, dict)
    return copy


def accepted(problem: Problem, document: dict[str, Any], *, by_digest: bool) -> bool:
    """Return whether `check` calls a document feasible."""
    try:
        references = references_of("plan.json", document, unchanged(document) if by_digest else None)
        return judge_references(problem.grasp, problem.timed, references).verdict == "feasible"
    except SynergripError:
        return False


def judged(name: str, most: int, seed: int = 0) -> Altered:
    """Alter `most` numbers of every key of the plan of a bundled problem."""
    rng, problem = np.random.default_rng(seed), load_problem(name)
    document = document_of(problem)
    assert accepted(problem, document, by_digest=True), name
    by_key: dict[str | int, list[tuple[Path, float]]] = {}
    for path, value in numbers(document):
        by_key.setdefault(path[0], []).append((path, value))
    found = Altered()
    for each in by_key.values():
        for i in rng.permutation(len(each))[:most]:
            path, value = each[i]
            other = altered(document, path, value * (1 + SHARE))
            found.count += 1
            key = ".".join(map(str, path))
            if accepted(problem, other, by_digest=False):
                found.compared.append((key, value))
                if accepted(problem, other, by_digest=True):
                    found.missed.append((key, value))
    return found


def main() -> None:
    """Print figures for some bundled problems."""
    most = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    whole = Altered()
    for name in sys.argv[2:] or NAMES:
        found = judged(name, most)
        whole = replace(whole, count=whole.count + found.count, missed=whole.missed + found.missed)
        print(f"{name}: {found.count} altered, {len(found.missed)} accepted", flush=True)
        print(f"  by the comparisons alone {len(found.compared)} accepted")
        kinds: dict[str, list[float]] = {}
        for key, value in found.compared:
            kinds.setdefault(key.split(".")[0], []).append(abs(value))
        for kind, values in kinds.items():
            print(f"    {kind}: {len(values)}, the largest {max(values):.1e}")
    print(f"{whole.count} altered, {len(whole.missed)} accepted")


if __name__ == "__main__":
    main()
