"""How far a walk got: what counts as followed, until when it was, and what keeps the hand from going on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import compress

import numpy as np

from synergrip.conic.conflicts import Conflict
from synergrip.documents.quantities import in_mm
from synergrip.documents.words import listed
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.straight_fingers import named, straight_fingers
from synergrip.hands.hand import Joint
from synergrip.hands.units import SI_UNITS
from synergrip.linalg import Array, frozen
from synergrip.planning.hindrances import Hindrance
from synergrip.planning.let_go import ranges_left
from synergrip.planning.reached import Reached
from synergrip.planning.straying import strayed
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import FOLLOWED, Walk
from synergrip.statics.twists import describe_displacement
from synergrip.tasks.tracking_along import joints_of

AT_END = {"rad": 5e-3, "m": 2e-4}
"""How near the end of its range a joint is at its limit: as far as the shortest piece of a motion takes it."""
FAR = {"rad": 0.05, "m": 2e-3}
"""How far a joint moves at least from one knot to the next where that is told of as a jump."""
SUDDEN, FEWEST = 4.0, 5
"""How many times as far as before and after it, and how many pieces there are at least."""
RANGES = "limits.joint_range"
MOST_JOINTS = 3
"""Joints that are named beside a posture."""
DEAR = 3.0
"""Near a straight posture some rigid motion takes joint motions larger than at the start by this factor."""


def off(walk: Walk, walker: Walker) -> Array:
    """Return how far (T,) the object is from where it is wanted [m], but for elastic motion and sag."""
    if walk.way is None or walk.until is not None:
        return np.full(len(walker.task.times), np.inf)
    return np.maximum(walk.way.behind, strayed(walk, walker))


def held_nowhere(walk: Walk, walker: Walker) -> bool:
    """Return whether the object is not even held at the first knot, where it is wanted where it starts."""
    if np.any(walker.wanted[0]):
        return False
    if walk.until is None:
        return not len(walk.executed.states)
    return walk.until == walker.task.times[0] and not walker.arrived(walk)


def reached_by(walk: Walk, walker: Walker) -> Reached:
    """Return until when the motion was followed, the nearest pose of the object, and what keeps it from going on."""
    times, executed = walker.task.times, walk.executed
    pose, until = executed.du[-1] if walker.arrived(walk) else np.zeros(6), walk.until
    astray, far, apart = False, off(walk, walker), ""
    if until is None:  # a walk of all knots that were reached, some of which are off
        k = len(executed.states) if walk.way is None else int(np.argmax(far > walker.allowed))
        pose, until = executed.du[k - 1] if k else np.zeros(6), float(times[max(k - 1, 0)])
        apart = _apart(walk, walker, slice(max(k - 1, 0), max(k, 1)))
        astray = walk.way is not None and walk.way.behind[k] <= walker.allowed
    told, most = describe_displacement(pose, walker.start.response.scale.length), float(far.max())
    told = told if pose.any() else "that of the start"
    beyond = f"the motion goes on, by {in_mm(most)} at most, where no rigid motion does"
    why = f"{beyond} (Gamma_ucs there)" if astray else hindrances(walk, walker)
    known = np.isfinite(most) and (astray or not _at_ends(walk, dict(_ends(walk, walker)), straight=False))
    because = f"not reached from t = {until:.3g} s: nearest pose {told}{apart}, because {why}"
    return Reached(until, frozen(pose), because, most if known else None)


def _apart(walk: Walk, walker: Walker, knots: slice) -> str:
    """Return how far the object is from where it is wanted in all, if by more than counts as followed: in words."""
    left, length = walk.executed.left(walker.wanted)[knots], walker.start.response.scale.length
    if np.abs(left * ([1.0] * 3 + [length] * 3)).max(initial=0.0) <= walker.allowed:
        return ""
    shifted, turned = (float(np.linalg.norm(part, axis=1).max()) for part in (left[:, :3], left[:, 3:]))
    return f" ({in_mm(shifted)} and {np.degrees(turned):.3g} deg off the wanted one, with what is elastic)"


def hindrances(walk: Walk, walker: Walker) -> str:
    """Return what keeps a walk from going on where it ends."""
    return "; ".join(_hindrances(walk, walker))


def _hindrances(walk: Walk, walker: Walker) -> Iterator[str]:
    """Yield what keeps a walk from going on where it ends: what its last pass met, or how its joints are."""
    met, ends = walk.hindered or Hindrance(), dict(_ends(walk, walker))
    straight = _dear(walk, walker) > DEAR
    near = _at_ends(walk, ends, straight=straight)
    others = [limit for limit in met.limits if limit.key != RANGES]
    if others:
        yield _binding(others)
    if met.execution or walk.executed.why:
        yield met.execution or walk.executed.why
    elif near:
        yield " and ".join(near)
    elif straight:
        yield f"the fingers are near a straight posture: {_straight_there(walk, walker)}"
    elif not others:
        apart = f": what it promises and what the hand does differ by {walk.gap:.3g} N"
        yield f"no step however short comes nearer{'' if walk.true or np.isinf(walk.gap) else apart}"
        if there := _in_line(walk, walker):
            yield f"near a straight posture: {there}"


def _at_ends(walk: Walk, ends: dict[str, tuple[Joint, float]], *, straight: bool) -> list[str]:
    """Return which joints are at the end of their ranges; where none is, those whose ranges the last pass met."""
    near = [told for told, (joint, off) in ends.items() if off < AT_END[SI_UNITS[joint.kind]]]
    if near or straight or walk.hindered is None:
        return near
    known = {joint.name for joint, _ in ends.values()}
    names = [name for limit in walk.hindered.limits if limit.key == RANGES for name in limit.items if name in known]
    return [min((off, told) for told, (joint, off) in ends.items() if joint.name == name)[1] for name in names]


def _binding(limits: Sequence[Conflict]) -> str:
    """Return that limits other than ranges of joints bind."""
    what = [f"{limit.key} ({', '.join(limit.items)})" for limit in limits]
    if len(what) > 1:
        return f"{listed(what)} cannot {'both' if len(what) == 2 else 'all'} be kept there"
    return f"{what[0]} cannot be kept there" if limits[0].friction else f"{what[0]} binds"


def _ends(walk: Walk, walker: Walker) -> Iterator[tuple[str, tuple[Joint, float]]]:
    """Yield for both ends of each joint's range what it would be to be there, the joint, and how far it is from it.

    Joints of idle fingers keep nothing from going on.
    """
    grasp = walker.start.grasp
    held = grasp.held
    if held is None or not len(walk.executed.states):
        return
    values = held.q + walk.executed.joint[-1]
    for joint, value in compress(zip(held.hand.joints, values, strict=True), _taking_part(grasp)):
        for end, off in (("lower", value - joint.lower), ("upper", joint.upper - value)):
            yield f"joint '{joint.name}' is at its {end} limit", (joint, float(off))


def _taking_part(grasp: Grasp) -> Array:
    """Return which joints (n_q,) move a contact, or go with synergies that do."""
    synergies = np.any(grasp.J @ grasp.S, axis=0)
    return np.asarray(np.any(grasp.J, axis=0) | np.any(grasp.S[:, synergies], axis=1))


def _straight_there(walk: Walk, walker: Walker) -> str:
    """Return which fingers are straight where a walk ends; else which joints its dearest rigid motion takes most of."""
    if (there := _in_line(walk, walker)) or walk.way is None:
        return there
    most = np.abs(np.linalg.svd(joints_of(walk.way.each[-1]))[0][:, 0])
    grasp = walker.start.grasp
    joints = [j for j in np.argsort(-most, kind="stable")[:MOST_JOINTS] if most[j] > most.max() / 2]
    moved = [c.name for c, rows in zip(grasp.contacts, grasp.rows, strict=True) if grasp.J[rows][:, joints].any()]
    names = listed([f"'{grasp.joints[j]}'" for j in joints])
    return f"some motion of the object takes much of {names} there, which {listed(moved)} is moved by"


def _in_line(walk: Walk, walker: Walker) -> str:
    """Return the names of the fingers that are straight where a walk ends; empty where none is."""
    states = walk.executed.states
    return named(straight_fingers(walker.start.grasp, states.q[-1])) if len(states) else ""


def _dear(walk: Walk, walker: Walker) -> float:
    """Return how much larger the joint motions of the dearest rigid motion are at the end of a walk than at start."""
    if walk.way is None or not walker.start.spaces.Gamma_ucs.shape[1]:
        return 1.0
    there, before = (np.linalg.norm(joints_of(at), 2) for at in (walk.way.each[-1], walker.start))
    return float(there / before)


def notes(walk: Walk, walker: Walker) -> Iterator[str]:
    """Yield how far the plan is from what was wanted, where that is more than elastic motion, and ranges let go."""
    yield from ranges_left(walker.task, walker.start.grasp, walk.executed.joint)
    if walk.behind > FOLLOWED:
        straight = _dear(walk, walker) > DEAR
        where, names = ("near a straight posture ", f"; {_straight_there(walk, walker)}") if straight else ("", "")
        yield (
            f"{where}the object stays up to {in_mm(walk.behind, 2)} behind the wanted motion, "
            f"within the {in_mm(walker.allowed, 2)} that count as followed{_apart(walk, walker, slice(None))}{names}"
        )
    yield from _jumps(walk, walker)


def _jumps(walk: Walk, walker: Walker) -> Iterator[str]:
    """Yield where a joint moves much farther from one knot to the next than it does anywhere near."""
    moved, held = np.abs(np.diff(walk.executed.joint, axis=0)), walker.start.grasp.held
    if len(moved) < FEWEST or held is None:
        return
    beside = np.maximum(np.concatenate([moved[:1], moved[:-1]]), np.concatenate([moved[1:], moved[-1:]]))
    least = np.array([FAR[SI_UNITS[joint.kind]] for joint in held.hand.joints])
    wild = (moved > least) & (moved > SUDDEN * beside)
    if wild.any():
        k, i = np.unravel_index(int(np.argmax(np.where(wild, moved / least, 0.0))), wild.shape)
        joint, times = held.hand.joints[int(i)], walker.task.times
        yield (
            f"joint '{joint.name}' jumps by {moved[k, i]:.3g} {SI_UNITS[joint.kind]} from t = {times[k]:.4g} s to "
            f"{times[k + 1]:.4g} s; limits.synergy_rate bounds how fast references go"
        )
