"""Random grasps that leave the object free to move in some way, and loads that do no work there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from elastic_grasp import held_motions
from made_kinds import made_kind
from random_grasps import random_grasp

from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import Array, frozen

FORMS = {"line": 1, "hinge": 1, "plane": 3, "ball": 3}
"""Form -> number of free motions: two hard fingers; the same and a smooth contact that pushes at their line; smooth
contacts at a disc, in its plane; smooth contacts at a ball."""


def free_grasp(rng: np.random.Generator, form: str, n_z: int = 4, *, placed: bool = True) -> Grasp:
    """Return a grasp of a form with a joint that carries the object; `placed`: anywhere and any way round."""
    contacts = _contacts(rng, form)
    if placed:
        turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        contacts = moved(contacts, turn * np.sign(np.linalg.det(turn)), 0.1 * rng.normal(size=3))
    kinds = [contact.kind.name for contact in contacts]
    grasp = random_grasp(rng, kinds, n_q=7, n_z=n_z, degenerate=bool(rng.random() < 0.6))
    G, J = grasp_matrix(contacts), np.array(grasp.J)
    J[:, 1] = 0.05 * G.T @ (np.array([1, 1, 1, 20, 20, 20]) * rng.normal(size=6))
    return replace(grasp, contacts=contacts, G=G, J=frozen(J))


def moved(contacts: tuple[Contact, ...], turn: Array, away: Array) -> tuple[Contact, ...]:
    """Return the contacts of a grasp that is turned (3, 3), then moved (3,)."""
    return tuple(
        replace(each, point=frozen(turn @ each.point + away), frame=frozen(turn @ each.frame)) for each in contacts
    )


def unloaded(rng: np.random.Generator, grasp: Grasp, count: int = 1) -> Array:
    """Return wrenches (count, 6) about B that contact forces can balance."""
    rank = held_motions(grasp).shape[1]
    return np.asarray(rng.normal(size=(count, rank)) @ np.linalg.svd(grasp.G)[0][:, :rank].T)


def _contacts(rng: np.random.Generator, form: str) -> tuple[Contact, ...]:
    """Return the contacts where the free motions are about x, all but those of the plane x, y, or turns about B."""
    if form in ("line", "hinge"):
        kinds = ["hard", "hard", "frictionless"][: 2 + (form == "hinge")]
        points = np.array([[-0.03, 0, 0], [0.04, 0, 0], [0.01, 0.02, 0]])
        normals = np.array([[1, *(0.1 * rng.normal(size=2))], [-1, *(0.1 * rng.normal(size=2))], [0.3, -1, 0]])
    else:
        kinds = ["frictionless"] * 6
        points = 0.04 * rng.normal(size=(6, 3)) * (1, 1, form == "ball")
        normals = -points
        if form == "plane":  # past the middle, else the object could turn about it
            normals = normals + rng.normal(size=(6, 1)) * points @ np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    return tuple(
        Contact(
            name=f"C{i + 1}", kind=made_kind(kind, 0.6 * (kind == "hard")), point=frozen(points[i]),
            frame=contact_frame(normals[i]),
        )
        for i, kind in enumerate(kinds)
    )  # fmt: skip
