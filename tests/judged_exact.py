"""Proofs of infeasibility replayed in exact arithmetic, and files that were tampered with.

    python tests/judged_exact.py 100

Random tasks are made infeasible by a limit of every kind in turn. Each proof is written to a file and re-checked by the
checker alone, in an interpreter without the package. Then its file is altered in a way of its own: as it is, and with
the marks of the file made anew by whoever altered it.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from random_formulations import LIMITS
from random_tasks import random_task_on_grasp

import synergrip.explain.exact.check_proof as checker
from synergrip.errors import SynergripError
from synergrip.explain.exact.exact_proof import ExactProof, exact_proof, marked
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan

Document = dict[str, Any]
KINDS = [each for each in LIMITS if each != "drift of the rigid part on some axes" and "sustained" not in each]
"""Of limits that take a plan away from a task whose wanted motion is followed rigidly: nothing drifts there.
Limits that add up over time have no proof in fractions."""
TIGHTER = (1.0, 0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4)
"""Shares of a limit that are tried until there is no plan."""


def infeasible(seed: int, kind: str) -> Infeasible | None:
    """A random task that has a plan until a limit of some kind takes it; None where it does not come to that."""
    grasp, task = random_task_on_grasp(np.random.default_rng(seed))
    if ("rate" in kind or "acceleration" in kind) and len(task.times) < 3:
        return None
    if not isinstance(plan(grasp, task), Plan):
        return None
    for share in TIGHTER:
        try:
            limit = LIMITS[kind](grasp).on(grasp)
            tight = limit if share == 1 else limit.loosened(share - 1)
            outcome = plan(grasp, replace(task, limits=(*task.limits, tight)))
        except SynergripError:
            return None
        if isinstance(outcome, Infeasible) and outcome.stage == "magnitude":
            return outcome
    return None


def alone(document: Document, problem: str = "") -> bool:
    """Whether the checker, by itself, takes a file for a proof (of a problem)."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "proof.json"
        path.write_text(json.dumps(document), encoding="utf-8")
        command = [sys.executable, "-I", checker.__file__, str(path), *([problem] if problem else [])]
        return subprocess.run(command, capture_output=True, check=False, timeout=300).returncode == 0


def numbers(part: Any) -> Iterator[tuple[Any, Any]]:
    """Where the numbers of a part of a document are, names and counts left out: a list or a dictionary, and the key."""
    for key, value in part.items() if isinstance(part, dict) else enumerate(part):
        if isinstance(value, dict | list):
            yield from numbers(value)
        elif isinstance(value, float) and value:
            yield part, key


def _changed(change: Callable[[float], float], *keys: str) -> Callable[[np.random.Generator, Document], None]:
    """Alter one number somewhere under keys of the problem, or in all of it."""

    def alter(rng: np.random.Generator, document: Document) -> None:
        problem = document["problem"]
        places = list(numbers({key: problem[key] for key in keys} if keys else problem))
        holder, key = places[rng.integers(len(places))]
        holder[key] = change(holder[key])

    return alter


def _drop(key: str) -> Callable[[np.random.Generator, Document], None]:
    def alter(rng: np.random.Generator, document: Document) -> None:
        part = document["problem"] if key in document["problem"] else document
        del part[key][int(rng.integers(len(part[key])))]

    return alter


def _swap(key: str) -> Callable[[np.random.Generator, Document], None]:
    def alter(rng: np.random.Generator, document: Document) -> None:
        part = document["problem"] if key in document["problem"] else document
        rows = part[key]
        other = [i for i in range(1, len(rows)) if rows[i] != rows[0]]
        if other:
            i = other[int(rng.integers(len(other)))]
            rows[0], rows[i] = rows[i], rows[0]
        else:
            rows.append(rows[0])

    return alter


def _multiplier(change: Callable[[float], float]) -> Callable[[np.random.Generator, Document], None]:
    def alter(rng: np.random.Generator, document: Document) -> None:
        places = list(numbers(document["multipliers"]))
        holder, key = places[rng.integers(len(places))]
        holder[key] = change(holder[key])

    return alter


def _later(rng: np.random.Generator, document: Document) -> None:
    entry = document["multipliers"][int(rng.integers(len(document["multipliers"])))]
    entry[1] += 1


def _of_another_limit(rng: np.random.Generator, document: Document) -> None:
    entry = document["multipliers"][int(rng.integers(len(document["multipliers"])))]
    entry[0] = (entry[0] + 1) % len(document["problem"]["limits"])


def _bit(value: float) -> float:
    return float(np.nextafter(value, np.inf))


PROBLEM = {
    "a bit of a number": _changed(_bit),
    "the sign of a number": _changed(lambda value: -value),
    "a number by a tenth": _changed(lambda value: 1.1 * value),
    "a number of a limit": _changed(lambda value: 0.5 * value, "limits"),
    "a bit of a matrix": _changed(_bit, "G", "J", "S", "C_s"),
    "the sign of an entry of a matrix": _changed(lambda value: -value, "G", "J", "S"),
    "a load": _changed(lambda value: 1.01 * value, "wrench"),
    "a smaller box": _changed(lambda value: 0.5 * value, "box"),
    "a limit left out": _drop("limits"),
    "a row of J left out": _drop("J"),
    "a column's row of S left out": _drop("S"),
    "a knot left out": _drop("wrench"),
    "rows of G exchanged": _swap("G"),
    "limits exchanged": _swap("limits"),
    "knots exchanged": _swap("wrench"),
}
"""What may be done to the problem that a file is about."""
MULTIPLIERS = {
    "a bit of a multiplier": _multiplier(_bit),
    "the sign of a multiplier": _multiplier(lambda value: -value),
    "a multiplier times ten": _multiplier(lambda value: 10 * value),
    "a multiplier left out": _drop("multipliers"),
    "multipliers exchanged": _swap("multipliers"),
    "a multiplier at another knot": _later,
    "a multiplier of another limit": _of_another_limit,
}
"""What may be done to its multipliers; some of it leaves a proof, of the same problem."""


def altered(rng: np.random.Generator, document: Document, how: str) -> Document:
    """A file with something in it that is not as it was written; its marks are as they were."""
    found = deepcopy(document)
    (PROBLEM | MULTIPLIERS)[how](rng, found)
    assert found != document, how
    return found


def main(count: int) -> int:
    """Judge as many proofs and as many altered files; return how many are wrong."""
    ways = [*PROBLEM, *MULTIPLIERS]
    wrong, proofs, seed, made, still = 0, 0, 0, Counter[str](), 0
    while proofs < count:
        seed, kind = seed + 1, KINDS[seed % len(KINDS)]
        outcome = infeasible(seed, kind)
        if outcome is None:
            continue
        proofs, found = proofs + 1, exact_proof(outcome)
        if not isinstance(found, ExactProof) or not alone(found.document(), found.of):
            print(f"seed {seed}, {kind}: no proof: {getattr(found, 'why', 'the checker says no')}", flush=True)
            wrong += 1
            continue
        made[kind] += 1
        how = ways[proofs % len(ways)]
        changed = altered(np.random.default_rng(seed), found.document(), how)
        again = marked(changed["problem"], changed["multipliers"])
        if alone(changed) or (how in PROBLEM and alone(again, found.of)):
            print(f"seed {seed}, {kind}: taken for a proof with {how} altered", flush=True)
            wrong += 1
        still += how in MULTIPLIERS and alone(again, found.of)
    print(f"{count} proofs replayed alone, {count} altered files: {wrong} wrong; limits {dict(made)}")
    print(f"altered multipliers, marked anew, that prove the same problem by their own sum: {still}")
    return wrong


if __name__ == "__main__":
    sys.exit(bool(main(int(sys.argv[1]))))
