"""What a plan uses of its limits in every case that it is to hold for, in the linear model: physics, and no program."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from synergrip.conic.allowed import Allowed
from synergrip.conic.departure import Departure, off_place, together
from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Looks
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.sampled import started
from synergrip.conic.well_formed import usage_of
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.in_case import InCase
from synergrip.planning.instants import intersample_of
from synergrip.planning.outcome import Check
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion, forward
from synergrip.tasks.timed_task import TimedTask

ALL_CASES = "what is allowed"
"""How the names of checks begin that are about all cases."""


def limits_of_cases(task: TimedTask) -> list[Limit]:
    """Return the limits that other loads change, at instants and over time; steps of references are always the same."""
    return [limit for limit in task.all_limits if limit.adds_up or not limit.couples_knots]


def in_cases(task: TimedTask, analysis: Analysis, formulation: Formulation, dz_r: Array) -> tuple[InCase, ...]:
    """Return what references (T, n_z) use of the limits in every case, at the knots and, where that counts, between."""
    allowed = formulation.allowed
    if allowed is None:
        return ()
    looks = Looks(task.times, task.wrench, formulation.target)
    between = intersample_of(task, analysis) if task.between == "hold" else None
    looks = looks if between is None else looks.and_then(between.all)
    references = interpolated(looks.times, task.times, dz_r)
    narrow = allowed.narrowed(formulation)
    there = replace(narrow, times=looks.times, wrench=looks.wrench, target=looks.target)
    limits = limits_of_cases(task)
    names = analysis.grasp.contact_names
    offs = off_place(narrow.map_of, analysis.grasp, allowed.gaps)
    found = []

    def use(limit: Limit, moved: Motion) -> Usage:
        """Return what is used of a limit: of one over time on straight lines from knot to knot."""
        if limit.adds_up:
            return usage_of(limit, narrow, moved.first(formulation.knots))
        return usage_of(limit, there, moved)

    for case in allowed.cases:
        extra = 0.0 if case.extra is None else case.extra.at(looks.times)
        motion = forward(analysis.response, looks.times, references, frozen(looks.wrench + extra))
        for words, moved in with_contacts_off(motion, analysis.grasp.S, allowed, offs, names):
            title = titled(allowed, narrow, formulation, case.title, words)
            found.append(InCase(title, tuple(use(limit, moved) for limit in limits)))
    if allowed.samples:
        moved_by = (forward(each, looks.times, references, looks.wrench, started(each)) for each in allowed.samples)
        found += _worst(len(allowed.samples), [tuple(use(limit, each) for limit in limits) for each in moved_by])
    return tuple(found)


def _worst(count: int, every: Sequence[tuple[Usage, ...]]) -> Iterator[InCase]:
    """Yield the sample with the smallest slip margin and, where it is another, the one nearest to or beyond a limit."""
    slips = min(every, key=lambda usages: float(usages[0].value.min()))
    nearest = max(every, key=lambda usages: max(usage.violation for usage in usages))
    yield InCase(f"the worst of {count} scenarios", slips)
    if nearest is not slips:
        yield InCase(f"of {count} scenarios the nearest to a limit", nearest)


def titled(allowed: Allowed, narrow: Formulation, stated: Formulation, *parts: str) -> str:
    """Return what a case is, in words."""
    pairs = zip(narrow.response.grasp.contacts, stated.response.grasp.contacts, strict=True)
    less = any(one.kind != other.kind for one, other in pairs)
    return ", ".join(part for part in ("least friction" if less else "", *parts) if part) or "as stated"


def with_contacts_off(
    motion: Motion, S: Array, allowed: Allowed, offs: Sequence[Departure], names: Sequence[str]
) -> Iterator[tuple[str, Motion]]:
    """Yield a motion with contacts off to either side, in words and as it then is; as it is where none may be off.

    Args:
        motion: with all contacts where they should be.
        S: (n_q, n_z) synergy matrix.
        allowed: which contacts may be off.
        offs: what each of these adds, at the times of the motion.
        names: of all contacts.
    """
    if not offs:
        yield "", motion
        return
    own = [name for name, gap in zip(names, allowed.gaps, strict=True) if gap > 0]
    for signs in allowed.signs:
        early, late = ([name for name, sign in zip(own, signs, strict=True) if sign == side] for side in (1, -1))
        words = [f"{' and '.join(each)} {side}" for each, side in ((early, "early"), (late, "late")) if each]
        yield ", ".join(words), _moved(motion, S, together(signs, offs))


def _moved(motion: Motion, S: Array, off: Departure) -> Motion:
    """Return a motion with what contacts that are off add to it."""
    return replace(
        motion, forces=frozen(motion.forces + off.force), torques=frozen(motion.torques + off.torque),
        efforts=frozen(motion.efforts + off.torque @ S), dq=frozen(motion.dq + off.joint),
        du=frozen(motion.du + off.displacement),
    )  # fmt: skip


def case_checks(cases: Sequence[InCase], tolerance: float) -> tuple[Check, ...]:
    """Return a check for every limit, of the case that is farthest beyond it."""
    if not cases:
        return ()
    return tuple(
        Check(f"{ALL_CASES}: {usage.title}", max(0.0, *(case.usages[i].violation for case in cases)), tolerance)
        for i, usage in enumerate(cases[0].usages)
    )
