"""Random errors of a grasp, written into the document of a plan for its second execution.

It knows nothing of the package (a test sees to that): what is off is drawn and put into the contacts, compliances and
forces at the start of `execution` by formulas of its own. Pads touch elsewhere on the surface, normals are tilted,
compliances are each multiplied; the object is carried at the start by the springs as they then are.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.linalg import block_diag
from scipy.spatial.transform import Rotation
from second.equilibrium import Equilibrium
from second.surfaces import face_at
from second.tree import read_tree

Array = np.ndarray
ALONG = 1e-6
"""How far a normal may be from that of the surface that is the same."""


@dataclass(frozen=True)
class Sizes:
    """How far off a grasp may be."""

    position: float  # [m]
    normal: float  # [rad]
    compliance: float


def off_by(document: dict[str, Any], sizes: Sizes, rng: np.random.Generator, repository: Path) -> dict[str, Any] | None:
    """Return a plan.json whose grasp has random errors; None where a contact would be beyond its face."""
    found = copy.deepcopy(document)
    block = found["execution"]
    tree = read_tree(repository / block["hand_file"], block["root_link"], block["joints"])
    load = Equilibrium(block, tree, "rolling").load_0.wrench
    links = tree.poses(np.array(block["q_0"], dtype=float)[None]).links
    for contact in block["contacts"]:
        if not _shifted(contact, block["object"], links[contact["link"]][0], sizes.position, rng):
            return None
        _tilted(contact, sizes.normal, rng)
    factors = 1 + sizes.compliance * rng.uniform(-1, 1, 3)
    for contact in block["contacts"]:
        contact["compliance"] = (factors[0] * np.array(contact["compliance"])).tolist()
    for key, factor in zip(("C_q", "C_z"), factors[1:], strict=True):
        block[key] = (factor * np.array(block[key], dtype=float)).tolist()
    block["lambda_0"] = carried(block, Equilibrium(block, tree, "rolling"), load).tolist()
    return found


def carried(block: dict[str, Any], equilibrium: Equilibrium, load: Array) -> Array:
    """Return the forces (n_l,) with which springs carry a load: ``C f + G' u = 0``, ``G f = -w``."""
    n_l, start = equilibrium.n_l, equilibrium.start
    poses = equilibrium.tree.poses(np.repeat(start.q[None], n_l, axis=0))
    p, R = np.repeat(start.p[None], n_l, axis=0), np.repeat(start.R[None], n_l, axis=0)
    seen = equilibrium._stretched(poses, p, R, start)
    wrenches, torques = equilibrium._exchanged(np.eye(n_l), seen, poses, p)  # of unit forces: G' and J
    S, C_q, C_z = (np.array(block[key], dtype=float) for key in ("S", "C_q", "C_z"))
    C = block_diag(*(np.array(contact["compliance"]) for contact in block["contacts"]))
    C = C + torques @ (C_q + S @ C_z @ S.T) @ torques.T
    size = np.abs(C).max()
    system = np.block([[C / size, wrenches], [wrenches.T, np.zeros((6, 6))]])
    return np.asarray(np.linalg.lstsq(system, np.concatenate([np.zeros(n_l), -load]), rcond=None)[0][:n_l])


def _shifted(contact: dict[str, Any], body: dict[str, Any], link: Array, most: float, rng: np.random.Generator) -> bool:
    """Shift a contact on the surface, evenly in a disc; return whether it is still on its face."""
    angle, size = rng.uniform(0, 2 * np.pi), most * np.sqrt(rng.random())
    n, t, o = np.array(contact["frame"], dtype=float)
    off, origin = size * (np.cos(angle) * t + np.sin(angle) * o), np.array(body["position_m"], dtype=float)
    pad, point = np.array(contact["pad_centre_m"], dtype=float), np.array(contact["point_m"], dtype=float)
    centre = link[:3, :3] @ pad + link[:3, 3]
    turn, moved = np.eye(3), centre + off
    if body["shape"] is not None:
        face = face_at(body["shape"], centre - origin)
        height, before = face.distance(centre - origin), face.normal(centre - origin)
        spot = centre - origin - height * before + off
        spot = spot - face.distance(spot) * face.normal(spot)
        if face.beyond(spot[None])[0] > 0:
            return False
        after = face.normal(spot)
        turn, moved = _between(before, after), origin + spot + height * after
        if np.allclose(n, -before, rtol=0, atol=ALONG):
            contact["frame"] = (np.array([n, t, o]) @ turn.T).tolist()
    contact["point_m"] = (moved + turn @ (point - centre)).tolist()
    contact["pad_centre_m"] = (pad + link[:3, :3].T @ (moved - centre)).tolist()
    return True


def _tilted(contact: dict[str, Any], most: float, rng: np.random.Generator) -> None:
    """Tilt the normal of a contact, evenly in a narrow cone."""
    angle, size = rng.uniform(0, 2 * np.pi), most * np.sqrt(rng.random())
    n, t, o = np.array(contact["frame"], dtype=float)
    turn = Rotation.from_rotvec(size * (np.cos(angle) * t + np.sin(angle) * o)).as_matrix()
    contact["frame"] = (np.array([n, t, o]) @ turn.T).tolist()


def _between(before: Array, after: Array) -> Array:
    """Return the smallest rotation that turns one unit vector into another."""
    axis = np.cross(before, after)
    sine = float(np.linalg.norm(axis))
    if sine < 1e-15:
        return np.eye(3)
    return np.asarray(Rotation.from_rotvec(axis / sine * np.arctan2(sine, before @ after)).as_matrix())
