"""What is seen of a plan in three dimensions, frame by frame: hand, object, contacts and their forces.

It is made from the document of a plan (plan.json) and the hand file that this names, so that a saved plan shows what
a new one does. Numbers only: how they are drawn is the business of others.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

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
    margins: Array  # (F, m) [N]
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
    """Return what is seen of a plan.

    Args:
        document: of the plan, as in plan.json.
        folder: where its hand file is looked for when it is not a bundled one.

    Raises:
        InputError: a plan of a grasp given as matrices, a hand file that is missing or has changed, values that are
            none.
    """
    if not isinstance(document.get("execution"), dict) or not isinstance(document.get("true"), dict):
        raise InputError.at("execution", "a grasp given as matrices has no hand to be seen")
    plan, told, true = (Told(part, key) for part, key in (
        (dict(document), ""), (document["execution"], "execution"), (document["true"], "true")))  # fmt: skip
    every = plan.array("time_s", (None,))
    shown = _thinned(len(every))
    tree, pads = hand_tree(told, folder), told.several("contacts")
    q = true.array("q", (len(every), len(told.texts("joints"))))[shown]
    bones, middles = _hand(tree, told.texts("joints"), q, pads)
    radii = np.array([pad.number("pad_radius_m") for pad in pads])
    du = true.array("du", (len(every), 6))[shown]
    shape, turned = _shape(told.inside("object").get("shape"))
    each = {key: true.array(key, (len(every), len(pads), 3))[shown] for key in ("place_m", "normal", "force_N")}
    return Scene(
        times=every[shown], left_out=len(every) - len(shown), bones=bones,
        thickness=_thickness(bones, radii), pads=middles, radii=radii, shape=shape,
        position=told.inside("object").array("position_m", (3,)) + du[:, :3], rotation=_turns(du[:, 3:]) @ turned,
        contacts=tuple(pad.text("name") for pad in pads), places=each["place_m"], normals=each["normal"],
        forces=each["force_N"], friction=np.array([_friction(pad) for pad in pads]), up=_up(told, shown),
        margins=true.inside("margin").array("per_contact_N", (len(every), len(pads)))[shown],
    )  # fmt: skip


def _thinned(count: int) -> Places:
    """Return which of the knots are shown: the first and the last of them always."""
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
