"""Where an object is touched by all contacts when a hand closes on it, among many places, found and drawn nearer."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.errors import Issue
from synergrip.grasps.asked_grasp import AskedGrasp
from synergrip.grasps.ball import MEETS
from synergrip.grasps.clearance import DEEP, FAR_INSIDE, deepest
from synergrip.grasps.closing_at_many import ClosedAtMany, Closer
from synergrip.grasps.pad_overlaps import overlaps
from synergrip.grasps.placing import SAME_SPOT
from synergrip.grasps.shapes.shape import Shape
from synergrip.grasps.stops import Flags
from synergrip.linalg import Array, Places
from synergrip.values import Value

ACROSS = 13
"""Places along the longest side of the space that is searched."""
CENTRED = 3
"""Times that the object is moved to the middle of the pads that stopped before all touched, and closed on again."""
AT_STOP = 0.01
"""Share of its range within which a joint stands at its stop."""
EDGE = 2e-3
"""[m] A contact that is nearer to an edge of the object may roll over it, or stands on it already."""
EDGE_SHARE, ALONG_FACE = 0.2, 0.99
"""As a share of half of the object where that is thin, and the cosine from which on two normals are of one face."""
NEAR = 400
"""How many places at most are moved so."""


@dataclass(frozen=True, eq=False, repr=False)
class TouchingPlaces(Value):
    """N places of an object at which all contacts touch."""

    positions: Array  # (N, 3) [m]
    q: Array  # (N, n_q)
    doubts: Places
    """(N,) what speaks against each: 1 where the skeleton of the hand runs through the object, 2 more where it runs
    deep through it, so that these come after all others; 1 where a contact is at an edge of it."""

    def taken(self, places: Places) -> TouchingPlaces:
        """Return some of them."""
        return TouchingPlaces(self.positions[places], self.q[places], self.doubts[places])

    def joined(self, other: TouchingPlaces) -> TouchingPlaces:
        """Return these places, then others."""
        names = ("positions", "q", "doubts")
        return TouchingPlaces(*(np.concatenate([getattr(self, name), getattr(other, name)]) for name in names))

    def different(self) -> TouchingPlaces:
        """Return them without those that stand twice, in their order."""
        return self.taken(_different(self.positions, digits=6))


def space(closer: Closer) -> tuple[Array, float]:
    """Return places (N, 3) all over where pads can touch the object as they close, and how far they are apart [m]."""
    path, half = closer.path().reshape(-1, 3), _half_size(closer.shape) + closer.radii.max(initial=0.0)
    lower, upper = path.min(axis=0) - half, path.max(axis=0) + half
    apart = float((upper - lower).max()) / (ACROSS - 1)
    counts = np.ceil((upper - lower) / apart).astype(int)
    begin = (lower + upper - counts * apart) / 2  # as much of it on one side as on the other: hands are symmetric
    return _box(begin, apart, counts + 1), apart


def around(positions: Array, apart: float) -> Array:
    """Return the places next to some (N, 3), `apart` [m], without those that stand twice."""
    steps = _box(np.full(3, -apart), apart, np.full(3, 3))
    near = (positions[:, None] + steps).reshape(-1, 3)
    return np.asarray(near[_different(near, digits=9)])


def closed_and_centred(closer: Closer, positions: Array) -> ClosedAtMany:
    """Return the hand closed on the object at places (N, 3), drawn nearer to where all pads touch at once.

    Pads that closing does not move say where the object can be: it is moved until they touch. A hand whose fingers stop
    together, as a gripper of one motor, touches with all pads only in their middle: there it is closed on again.
    """
    held = ~closer.joints.moved
    for _ in range(CENTRED if held.any() else 0):
        seen = closer.seen(positions, np.tile(closer.begin, (len(positions), 1)))
        positions = positions + _shift(seen.outward[:, held], seen.gaps[:, held])
    found = last = closer.closed(positions)
    for _ in range(CENTRED):
        off = np.abs(last.gaps).max(axis=1)
        near = np.argsort(off, kind="stable")
        near = near[off[near] > MEETS][:NEAR]
        if not len(near):
            break
        last = closer.closed(last.positions[near] + _shift(last.outward[near], last.gaps[near]))
        found = found.joined(last)
    return found


def touching_places(closer: Closer, found: ClosedAtMany) -> TouchingPlaces:
    """Return the places at which all contacts touch, each on a spot of its own, and no pads are inside each other."""
    all_touch = np.flatnonzero(found.touching.all(axis=1))
    all_touch = all_touch[~_on_one_spot(closer, found.q[all_touch], found.outward[all_touch])]
    if len(all_touch):
        _, depths = overlaps(closer.asked.hand, found.q[all_touch], closer.asked.touches)
        all_touch = all_touch[depths.max(axis=1, initial=0.0) <= MEETS]
    positions, q = found.positions[all_touch], found.q[all_touch]
    if not len(q):
        return TouchingPlaces(positions, q, np.zeros(0, dtype=int))
    depths = deepest(closer.asked.hand, q, closer.shape, positions, closer.asked.touches)
    edges = _at_edges(closer, positions, q)
    return TouchingPlaces(positions, q, np.asarray((depths > DEEP) + 2 * (depths > FAR_INSIDE) + edges))


def _at_edges(closer: Closer, positions: Array, q: Array) -> Flags:
    """Tell at which places (N, 3) a contact is at an edge: a little inside the object, another face is nearer."""
    centres = closer.centres(q) - positions[:, None]
    off, outward = closer.shape.surface(centres)
    deep = min(EDGE, EDGE_SHARE * float(_half_size(closer.shape).min()))
    _, below = closer.shape.surface(centres - (off[..., None] + deep) * outward)
    return np.asarray(((below * outward).sum(axis=-1) < ALONG_FACE).any(axis=1))


def _on_one_spot(closer: Closer, q: Array, outward: Array) -> Flags:
    """Tell in which postures (N, n_q) two contacts are on the same spot, with the normals outward (N, n_c, 3)."""
    spots = closer.centres(q) - closer.radii[:, None] * outward
    apart = np.linalg.norm(spots[:, :, None] - spots[:, None], axis=-1) + np.diag(np.full(len(closer.pads), np.inf))
    return np.asarray((apart < SAME_SPOT).any(axis=(1, 2)))


def off_centre(asked: AskedGrasp, places: TouchingPlaces) -> Array:
    """Return how far the middle of the pads is from that of the object (N,) [m]."""
    pads = [(touch.pad.link, touch.pad.point) for touch in asked.touches]
    middles = asked.hand.kinematics.along(places.q, pads).position.mean(axis=1)
    return np.asarray(np.linalg.norm(middles - places.positions, axis=1))


def at_stops(asked: AskedGrasp, q: Array) -> Flags:
    """Return which joints (N, n_q) closing has brought to their stops, or within 1 % of their range of it."""
    closing = np.zeros(len(asked.q)) if asked.closing is None else asked.closing
    lower, upper = (np.array([getattr(joint, end) for joint in asked.hand.joints]) for end in ("lower", "upper"))
    left = np.where(closing > 0, upper - q, q - lower)
    room = np.where(np.isfinite(upper - lower), AT_STOP * (upper - lower), 0.0)
    return np.asarray((closing != 0) & (left <= room))


def nearest(closer: Closer, found: ClosedAtMany) -> tuple[Array, Issue]:
    """Return where it comes nearest to all contacts touching (3,), and what is to be said of it.

    That is where most contacts touch, and of those places where the others are least far away.
    """
    ask = "start from a more open posture, close along something else, or leave contacts out"
    if not len(found.q):
        message = f"wherever the object is, a pad is inside the {closer.shape.title} before the hand closes; {ask}"
        return closer.path().mean(axis=(0, 1)), Issue(message, key="object.position")
    if told := _overlapping(closer, found, ask):
        return told
    off = np.where(found.touching, 0.0, np.abs(found.gaps))
    best = int(np.lexsort((off.sum(axis=1), -found.touching.sum(axis=1)))[0])
    if found.touching[best].all():
        message = f"wherever all contacts touch, two of them are on the same spot of the {closer.shape.title}; {ask}"
        return found.positions[best], Issue(message, key="object.position")
    names = [touch.name for touch in closer.asked.touches]
    ways = _ways(closer)
    touch = [name for name, yes in zip(names, found.touching[best], strict=True) if yes]
    others = [
        f"{name} {_away(float(gap), float(facing))}{way}"
        for name, yes, gap, facing, way in zip(
            names, found.touching[best], found.gaps[best], found.facing[best], ways, strict=True
        )
        if not yes
    ]
    message = (
        f"nowhere do all contacts touch when the hand closes; nearest at {_in_mm(found.positions[best])}: "
        f"{' and '.join(touch) or 'none'} touch{'es' * (len(touch) < 2)}, {', '.join(others)}; {ask}"
    )
    return found.positions[best], Issue(message, key="object.position")


def _overlapping(closer: Closer, found: ClosedAtMany, ask: str) -> tuple[Array, Issue] | None:
    """Return the place where pads are least inside each other, when they are wherever all contacts touch."""
    together = np.flatnonzero(found.touching.all(axis=1))
    if not len(together):
        return None
    pairs, depths = overlaps(closer.asked.hand, found.q[together], closer.asked.touches)
    most = depths.max(axis=1, initial=0.0)
    least = int(np.argmin(most))
    if most[least] <= MEETS:
        return None
    position, (a, b) = found.positions[together[least]], pairs[int(np.argmax(depths[least]))]
    message = (
        f"wherever all contacts touch, pads are inside each other; least at {_in_mm(position)}: '{a}' and '{b}' by "
        f"{in_mm(float(most[least]))}; {ask}"
    )
    return position, Issue(message, key="object.position")


def _ways(closer: Closer) -> list[str]:
    """Return of each pad what keeps it from meeting the others as the hand closes; nothing where it may."""
    path = closer.path()
    off = np.linalg.norm(path - path[0].mean(axis=0), axis=-1)  # from the middle of the pads where closing begins
    leaves = off[1:].min(axis=0) > off[0]
    return [
        (" (closing takes it away from the others)" if away else "") if moved else " (closing does not move it)"
        for moved, away in zip(closer.joints.moved, leaves, strict=True)
    ]


def _in_mm(position: Array) -> str:
    return f"({', '.join(f'{1e3 * value:.1f}' for value in position)}) mm"


def _away(gap: float, facing: float) -> str:
    if abs(gap) <= MEETS:
        return f"faces away from the object ({np.degrees(np.arccos(np.clip(facing, -1, 1))):.0f} deg)"
    return f"stays {in_mm(gap)} away" if gap > 0 else f"is {in_mm(-gap)} inside"


def _shift(outward: Array, gaps: Array) -> Array:
    """Return by how much objects are to be moved (N, 3) for their pads' gaps (N, k) to vanish, as nearly as it goes."""
    return np.asarray((np.linalg.pinv(outward, rcond=1e-6) @ gaps[..., None])[..., 0])


def _different(positions: Array, digits: int) -> Places:
    """Return which of positions (N, 3) [m] are no second ones, in their order, with so many digits."""
    _, first = np.unique(np.round(positions, digits), axis=0, return_index=True)
    return np.sort(first)


def _box(begin: Array, apart: float, counts: Array) -> Array:
    axes = [begin[i] + apart * np.arange(int(counts[i])) for i in range(3)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def _half_size(shape: Shape) -> Array:
    """Return how far a shape reaches along each axis of the palm (3,) [m]."""
    return np.array([abs(float(shape.farthest(axis) @ axis)) for axis in np.eye(3)])
