"""What is seen of an answer: its document (plan.json) and the hand file that this names, made into a scene.

A saved answer shows what a new one does.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from synergrip.errors import InputError
from synergrip.grasps.shapes.shape import Shape
from synergrip.grasps.shapes.shapes import SHAPES
from synergrip.hands.kinematics import kinematics
from synergrip.hands.models.tree import LinkTree
from synergrip.linalg import Array, Places
from synergrip.reports.pictures.bones import bone_ends, bones_between
from synergrip.reports.view.scene import Scene, thickness_of
from synergrip.simulation.played_plan import hand_tree
from synergrip.simulation.told_values import Told
from synergrip.vectors import rotation_matrices

MOST = 400
"""Frames that are shown at most: with more knots, some are left out, evenly."""


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
    tree = hand_tree(told, folder)
    bones, places, turned_links = _hand(tree, joints, states.q[shown], pads)
    radii = np.array([pad.number("pad_radius_m") for pad in pads])
    shape, turned = _shape(told.inside("object").get("shape"))
    du = states.du[shown]
    return Scene(
        times=states.times[shown], left_out=len(states.times) - len(shown), bones=bones,
        thickness=thickness_of(bones[0], radii), link_names=tree.links, links=places[:, : len(tree.links)],
        turned=turned_links, pad_names=tuple(pad.text("name") for pad in pads), pads=places[:, len(tree.links) :],
        pushing=states.normals[shown], radii=radii, shape=shape,
        position=told.inside("object").array("position_m", (3,)) + du[:, :3],
        rotation=rotation_matrices(du[:, 3:]) @ turned,
        contacts=tuple(pad.text("name") for pad in pads), places=states.places[shown], normals=states.normals[shown],
        forces=states.forces[shown], friction=np.array([_friction(pad) for pad in pads]), up=_up(told, shown),
        margins=None if states.margins is None else states.margins[shown], gravity=bool(told.get("gravity_m_s2")),
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


def _hand(tree: LinkTree, joints: Any, q: Array, pads: list[Told]) -> tuple[Array, Array, Array]:
    """Return bones (F, n, 2, 3), origins of links and middles of pads (F, l + m, 3), axes of links (F, l, 3, 3)."""
    links, tips = list(tree.links), [(pad.text("link"), pad.array("pad_centre_m", (3,))) for pad in pads]
    points = [*((link, np.zeros(3)) for link in links), *tips]
    found = kinematics(tree, joints).along(q, points)
    ends = bone_ends(links, tree.parents, {len(links) + i: link for i, (link, _) in enumerate(tips)})
    return bones_between(found.position, ends), found.position, found.rotation[:, : len(links)]


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
