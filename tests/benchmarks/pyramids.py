"""What inscribed friction pyramids cost over many random tasks, and how far a QP solver can be believed on them.

    python tests/benchmarks/pyramids.py [COUNT [SOLVER]]

plans COUNT (300) random tasks of each family by cones, and again within pyramids of 4, 8 and 16 facets. Prints the
share of the feasible tasks that pyramids reject (proven), the median of what they add to the least peak normal force
where they do not, and what SOLVER (osqp; any that qpsolvers finds) makes of the same programs: the share of the tasks
not rejected for which its references pass our check, and how many of all it calls solved fail the check.

- "free": four hard-finger contacts with mu = 0.5 anywhere on a sphere, all forces controllable, a random load, no
  limit but friction: what geometry alone loses.
- "hand": a few synergies, hard and soft fingers, and limits on forces, torques and references; a third of them ask
  for nearly the largest slip margin there is (tests/random_tasks.py).
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent))

from made_kinds import made_kind
from named_goals import goals
from random_tasks import RADIUS, random_task_on_grasp

from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import frozen
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.planning.pyramids import Comparison, compare, requested
from synergrip.tasks.timed_task import TimedTask, still

FACETS = (4, 8, 16)
Maker = Callable[[np.random.Generator], tuple[Grasp, TimedTask]]


def free_task(rng: np.random.Generator) -> tuple[Grasp, TimedTask]:
    """Four contacts anywhere on a sphere, every force controllable, and a load of 1 N."""
    contacts = []
    for i in range(4):
        outward = rng.normal(size=3)
        outward /= np.linalg.norm(outward)
        kind, frame = "hard", contact_frame(-outward)
        contacts.append(
            Contact(name=f"C{i + 1}", kind=made_kind(kind, 0.5, 0.0), point=frozen(RADIUS * outward), frame=frame)
        )
    size = 3 * len(contacts)
    names = tuple(f"q{i + 1}" for i in range(size))
    one, zero = frozen(np.eye(size)), frozen(np.zeros((size, size)))
    G = grasp_matrix(contacts)
    grasp = Grasp(
        title="free",
        contacts=tuple(contacts),
        G=G,
        J=one,
        S=one,
        C_s=frozen(1e-3 * np.eye(size)),
        C_q=zero,
        C_z=zero,
        lambda_0=None,
        w_0=frozen(np.zeros(6)),
        joints=names,
        synergies=names,
    )
    force = rng.normal(size=3)
    wrench = np.r_[force / np.linalg.norm(force), 0.2 * RADIUS * rng.normal(size=3)][None]
    times = frozen(np.zeros(1))
    return grasp, TimedTask(times, frozen(wrench), still(times), 0.0, (), goals("peak_force"))


def hand_task(rng: np.random.Generator) -> tuple[Grasp, TimedTask]:
    """A task of a hand with few synergies, for the least peak force."""
    grasp, task = random_task_on_grasp(rng)
    return grasp, replace(task, goals=goals("peak_force"))


def plans(make: Maker, count: int) -> Iterator[Plan]:
    """Yield the verified plans of random tasks."""
    for seed in range(count):
        outcome = plan(*make(np.random.default_rng(seed)))
        if isinstance(outcome, Plan):
            yield outcome


def row(comparisons: list[Comparison]) -> str:
    """Return the figures of one family and number of facets."""
    rejected = [c for c in comparisons if c.rejected]
    undecided = sum(c.rejected is None for c in comparisons)
    kept = [c for c in comparisons if c.rejected is False]
    extra = np.median([c.peak_ratio - 1 for c in kept if c.peak_ratio is not None])
    answers = [c.answer for c in comparisons if c.answer is not None]
    good = sum(c.answer is not None and c.answer.verified for c in kept)
    wrong = sum(answer.status.lower() == "solved" and not answer.verified for answer in answers)
    times = np.median([c.time_ratio for c in comparisons if c.time_ratio is not None])
    return (
        f"{len(comparisons):>8}  {len(rejected) / len(comparisons):>8.1%}  {undecided:>9}  {extra:>+10.1%}  "
        f"{good / max(len(kept), 1):>8.1%}  {wrong:>15}  {times:>10.1f}"
    )


def main() -> None:
    """Print one line for each family and number of facets."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 300
    requests = [requested(facets, sys.argv[2] if len(sys.argv) > 2 else "osqp") for facets in FACETS]
    print("family  facets  feasible  rejected  undecided  peak force  verified  solved but not  time ratio")
    families: dict[str, Maker] = {"free": free_task, "hand": hand_task}
    for name, make in families.items():
        comparisons: dict[int, list[Comparison]] = {request.facets: [] for request in requests}
        for cones in plans(make, count):
            for request in requests:
                comparisons[request.facets].append(compare(cones, request))
        for facets, found in comparisons.items():
            print(f"{name:<6}  {facets:>6}  {row(found)}", flush=True)


if __name__ == "__main__":
    main()
