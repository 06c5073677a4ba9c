"""What is seen of an answer in three dimensions, frame by frame: hand, object, contacts and their forces.

It is made from the document of an answer (plan.json) and the hand file that this names, so that a saved one shows
what a new one does. Numbers only: how they are drawn is the business of others.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from synergrip.errors import InputError
from synergrip.grasps.shapes.shape import Shape
from synergrip.grasps.shapes.shapes import SHAPES
from synergrip.hands.kinematics import kinematics
from synergrip.hands.models.tree import LinkTree
from synergrip.linalg import Array, Places
from synergrip.simulation.played_plan import hand_tree
from synergrip.simulation.told_values import Told
from synergrip.values import Value

MOST = 400
"""Frames that are shown at most: with more knots, some are left out, evenly."""
SHORTEST = 1e-6
"""A bone below this is the same point twice [m]."""
THICK = 0.12
"""Radius of bones where no pad has one, as a share of their median length."""
SLIM = 0.7
"""Radius of bones as a share of the median radius of the pads."""


@dataclass(frozen=True, eq=False, repr=False)
class Scene(Value):
    """F frames of m contacts; SI units, axes of the palm, which stands still here: what else would turn is gravity."""

    times: Array  # (F,) [s]
    left_out: int
    """How many knots are not shown."""
    bones: Array  # (F, n, 2, 3) from a joint to the next, or to a pad [m]
    thickness: float  # [m] radius of bones
    pads: Array  # (F, m, 3) their middles [m]
    radii: Array  # (m,) of the pads, 0 for points [m]
    shape: Shape | None
    position: Array  # (F, 3) of the object [m]
    rotation: Array  # (F, 3, 3) of its shape
    contacts: tuple[str, ...]
    places: Array  # (F, m, 3) where the contacts are [m]
    normals: Array  # (F, m, 3) into the object
    forces: Array  # (F, m, 3) on the object [N]
    margins: Array | None  # (F, m) [N]; None where no force is known
    friction: Array  # (m,) 0 where there is none
    up: Array  # (F, 3) against gravity, or the palm's z where none is known

    @property
    def size(self) -> float:
        """[m] How large what is held is: half the side of the box around contacts and object."""
        points = self.places[0] if self.shape is None else np.vstack([self.places[0], self._corners])
        return float(np.ptp(points, axis=0).max() / 2) or 0.05

    @property
    def _corners(self) -> Array:
        """(6, 3) the farthest points of the object along the axes of the palm, at the start."""
        assert self.shape is not None
        turned, axes = self.rotation[0], np.vstack([np.eye(3), -np.eye(3)])
        farthest = [turned @ self.shape.farthest(turned.T @ axis) for axis in axes]
        return np.asarray(self.position[0] + np.array(farthest))


def scene_of(document: Mapping[str, Any], folder: Path = Path()) -> Scene:
    """Return what is seen of an answer: its true states, or the hand at the start where it has none.

    Args:
        document: of the answer, as in plan.json.
        folder: where its hand file is looked for when it is not a bundled one.

    Raises:
        InputError: an answer about a grasp given as matrices, a hand file that is missing or has changed, values that
            are none.
    """
    if not isinstance(document.get("execution"), dict):
        raise InputError.at("execution", "a grasp given as matrices has no hand to be seen")
    told, states = Told(document["execution"], "execution"), _states(document)
    shown, pads, joints = thinned(len(states.times)), told.several("contacts"), told.texts("joints")
    bones, middles = _hand(hand_tree(told, folder), joints, states.q[shown], pads)
    radii = np.array([pad.number("pad_radius_m") for pad in pads])
    shape, turned = _shape(told.inside("object").get("shape"))
    du = states.du[shown]
    return Scene(
        times=states.times[shown], left_out=len(states.times) - len(shown), bones=bones,
        thickness=_thickness(bones, radii), pads=middles, radii=radii, shape=shape,
        position=told.inside("object").array("position_m", (3,)) + du[:, :3], rotation=_turns(du[:, 3:]) @ turned,
        contacts=tuple(pad.text("name") for pad in pads), places=states.places[shown], normals=states.normals[shown],
        forces=states.forces[shown], friction=np.array([_friction(pad) for pad in pads]), up=_up(told, shown),
        margins=None if states.margins is None else states.margins[shown],
    )  # fmt: skip


class _States(NamedTuple):
    """States of hand and object at some knots, from the first on."""

    times: Array
    q: Array
    du: Array
    places: Array
    normals: Array
    forces: Array
    margins: Array | None


def _states(document: Mapping[str, Any]) -> _States:
    """Return the true states of an answer; else that of the start, in which no force is known."""
    told, plan = Told(document["execution"], "execution"), Told(dict(document), "")
    pads, n_q = told.several("contacts"), len(told.texts("joints"))
    if not isinstance(document.get("true"), dict):
        places = np.array([[pad.array("point_m", (3,)) for pad in pads]])
        normals = np.array([[pad.array("frame", (3, 3))[0] for pad in pads]])
        start = plan.array("time_s", (None,))[:1]
        return _States(start, told.array("q_0", (n_q,))[None], np.zeros((1, 6)), places, normals, 0 * places, None)
    true = Told(document["true"], "true")
    times = (true if true.get("time_s") is not None else plan).array("time_s", (None,))  # of an unknown as far as known
    count = len(times)
    places, normals, forces = (true.array(key, (count, len(pads), 3)) for key in ("place_m", "normal", "force_N"))
    margins = true.inside("margin").array("per_contact_N", (count, len(pads)))
    return _States(times, true.array("q", (count, n_q)), true.array("du", (count, 6)), places, normals, forces, margins)


def thinned(count: int) -> Places:
    """Return which of so many knots are shown, `MOST` at most: the first and the last of them always."""
    return np.unique(np.round(np.linspace(0, count - 1, min(count, MOST))).astype(np.intp))


def _hand(tree: LinkTree, joints: Any, q: Array, pads: list[Told]) -> tuple[Array, Array]:
    """Return bones (F, n, 2, 3) and the middles of the pads (F, m, 3)."""
    links, tips = list(tree.links), [(pad.text("link"), pad.array("pad_centre_m", (3,))) for pad in pads]
    points = [*((link, np.zeros(3)) for link in links), *tips]
    found = kinematics(tree, joints).along(q, points).position
    number = {link: i for i, link in enumerate(links)}
    pairs = [(number[above], number[link]) for link, above in tree.parents.items()]
    pairs += [(number[link], len(links) + i) for i, (link, _) in enumerate(tips)]
    bones = np.array([np.stack([found[:, a], found[:, b]], axis=1) for a, b in pairs]).swapaxes(0, 1)
    long = np.linalg.norm(bones[:, :, 1] - bones[:, :, 0], axis=2).max(axis=0) > SHORTEST
    return bones[:, long], found[:, len(links) :]


def _thickness(bones: Array, radii: Array) -> float:
    if np.any(radii > 0):
        return SLIM * float(np.median(radii[radii > 0]))
    lengths = np.linalg.norm(bones[0, :, 1] - bones[0, :, 0], axis=1)
    return THICK * float(np.median(lengths)) if len(lengths) else 0.005


def _shape(told: Any) -> tuple[Shape | None, Array]:
    """Return the shape of the object and how it is turned in it; None for a bare mass."""
    if not isinstance(told, dict) or len(told) != 1:
        return None, np.eye(3)
    ((name, sizes),) = told.items()
    if name not in SHAPES or not isinstance(sizes, dict):
        return None, np.eye(3)
    given = {size.name: sizes.get(f"{size.name}_m") for size in SHAPES[name].sizes}
    return SHAPES[name](**given), np.array(sizes.get("rotation", np.eye(3)), dtype=float)


def _friction(pad: Told) -> float:
    parameters = pad.inside("parameters")
    return parameters.number("friction") if parameters.get("friction") is not None else 0.0


def _up(told: Told, shown: Places) -> Array:
    """Return the direction (F, 3) against gravity as the palm sees it."""
    gravity = np.array(told.get("gravity_m_s2") or np.zeros(3), dtype=float)
    size = float(np.linalg.norm(gravity))
    up = -gravity / size if size > 0 else np.array([0.0, 0.0, 1.0])
    if told.get("palm") is None:
        return np.tile(up, (len(shown), 1))
    every = told.several("palm")
    return np.array([up @ every[k].array("rotation", (3, 3)) for k in shown])


def _turns(vectors: Array) -> Array:
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_rotvec(vectors).as_matrix())
