"""A plan as another program reads it: what plan.json alone says of hand, object, contacts, references and load."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from hashlib import sha256
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.documents.documents import read_document
from synergrip.errors import InputError, one_of
from synergrip.files import bundled
from synergrip.grasps.compliance import joint_compliance
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.contacts.kinds import contact_kind
from synergrip.grasps.shapes.shapes import SHAPES
from synergrip.hands.kinematics import MujocoKinematics, kinematics
from synergrip.hands.models.model_file import read_model
from synergrip.hands.models.tree import LinkTree
from synergrip.linalg import Array, frozen
from synergrip.plain_file import read_bytes
from synergrip.planning.digest import stated_digest, unchanged
from synergrip.planning.references import plan_file
from synergrip.simulation.geoms import GEOMS, sizes_of
from synergrip.simulation.told_values import Told
from synergrip.values import Value

KEY = "PLAN"


@dataclass(frozen=True, eq=False, repr=False)
class Pad(Value):
    """One contact, and the pad that touches there."""

    contact: Contact
    """Its point from the origin of the object, its frame in axes of the palm."""
    link: str
    centre: Array  # (3,) of the pad in the frame of the link [m]
    radius: float  # [m]; 0 for a point
    compliance: Array  # (rows, rows) its block of C_s


@dataclass(frozen=True, eq=False, repr=False)
class Load(Value):
    """The external load: straight lines between instants, which stand twice where it jumps."""

    times: Array  # (L,) [s]
    wrench: Array  # (L, 6) about the origin of the object as it moves, axes of the palm
    at: Array  # (m, 3) points of the object, its axes at the start, from its origin [m]
    forces: Array  # (L, m, 3) at these points; their moment, had the object not turned, is part of the wrench


@dataclass(frozen=True, eq=False, repr=False)
class PlayedPlan(Value):
    """What is played. SI units, axes of the palm."""

    title: str
    tree: LinkTree
    kinematics: MujocoKinematics
    q_0: Array  # (n_q,)
    S: Array  # (n_q, n_z)
    C: Array  # (n_q, n_q) C_q + S C_z S'
    tau_0: Array  # (n_q,)
    forces_0: tuple[Array, ...]
    """lambda_0, contact by contact."""
    pads: tuple[Pad, ...]
    position: Array  # (3,) of the object at the start
    shape: Mapping[str, Any]
    mass: float | None  # [kg]
    inertia: Array | None  # (3, 3) [kg m^2]
    times: Array  # (T,) [s] of the knots
    dz_r: Array  # (T, n_z)
    forces: Array  # (T, n_l) promised
    du: Array  # (T, 6) promised motion of the object
    margins: Array  # (T, n_c) promised [N]
    true_margins: Array | None  # (T, n_c) at the true equilibrium, when the plan tells them
    contact_model: str | None
    """How contacts move at the true equilibrium, when the plan tells it: "rolling" or "fixed"."""
    load: Load
    unchanged: bool | None = None
    """Whether the file is as it was written, by its digest; None when it has none. What one that was
    changed says of true equilibria is left out: nobody has found them."""
    digest: str | None = None
    """Of a file that is as it was written, by which it is known again; None otherwise."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the contacts."""
        return tuple(pad.contact.name for pad in self.pads)

    def with_friction(self, factor: float) -> PlayedPlan:
        """Return it with all friction multiplied by a factor."""
        if factor == 1.0:
            return self
        contacts = [replace(pad.contact, kind=pad.contact.kind.slippery(factor)) for pad in self.pads]
        pads = [replace(pad, contact=contact) for pad, contact in zip(self.pads, contacts, strict=True)]
        return replace(self, pads=tuple(pads))


def read_played_plan(path: Path) -> PlayedPlan:
    """Return the plan in a folder or a plan.json.

    Raises:
        InputError: no such file, no plan, a plan of a grasp given as matrices, or values that are none; a hand file
            that is missing or another one than it was.
    """
    file = plan_file(path)
    data = read_document(file, "plan", KEY, numbers=True).data
    if "dz_r" not in data or "time_s" not in data:
        verdict = data.get("verdict")
        said = f"its verdict is '{verdict}'" if isinstance(verdict, str) else "dz_r and time_s are missing"
        raise InputError.at(KEY, f"'{file}' holds no plan: {said}; make one with `synergrip plan PROBLEM`")
    if not isinstance(data.get("execution"), dict):
        message = "has no 'execution': a grasp given as matrices has no hand to move; plan it on a hand to simulate it"
        raise InputError.at(KEY, f"'{file}' {message}")
    try:
        whole = unchanged(data)
        found = _played(Told(data, ""), Told(data["execution"], "execution"), file.parent, whole)
        return replace(found, digest=stated_digest(data) if whole else None)
    except InputError as error:
        raise error.under(f"{KEY} '{file}'") from None


def _played(plan: Told, told: Told, folder: Path, whole: bool | None) -> PlayedPlan:
    joints = told.texts("joints")
    n_q, times = len(joints), plan.array("time_s", (None,))
    tree = hand_tree(told, folder)
    q_0, S = told.array("q_0", (n_q,)), told.array("S", (n_q, None))
    n_t, n_z = len(times), S.shape[1]
    C_q, C_z = told.array("C_q", (n_q, n_q)), told.array("C_z", (n_z, n_z))
    if not np.all(np.diff(times) > 0):
        raise InputError.at("time_s", "times must increase")
    body = told.inside("object")
    pads = tuple(pad_of(contact, body.array("position_m", (3,))) for contact in told.several("contacts"))
    rows = np.cumsum([0, *(pad.contact.n_rows for pad in pads)])
    lambda_0 = told.array("lambda_0", (int(rows[-1]),))
    mass, shape = body.get("mass_kg"), body.get("shape")
    true = plan.inside("true") if plan.get("true") is not None and whole is not False else None
    shown = (true.inside("margin") if true.get("margin") is not None else None) if true else None
    return PlayedPlan(
        str(plan.get("title") or "plan"), tree, kinematics(tree, joints), q_0, S, frozen(joint_compliance(C_q, S, C_z)),
        told.array("tau_0", (n_q,)), tuple(frozen(lambda_0[a:b]) for a, b in pairwise(rows)), pads,
        body.array("position_m", (3,)), _shape(shape, told), None if mass is None else body.positive("mass_kg"),
        body.perhaps("inertia_kg_m2", Told.array, (3, 3)),
        times, plan.array("dz_r", (n_t, n_z)), plan.array("lambda", (n_t, len(lambda_0))), plan.array("du", (n_t, 6)),
        plan.inside("margin").array("per_contact_N", (n_t, len(pads))),
        None if shown is None else shown.array("per_contact_N", (n_t, len(pads))),
        None if true is None or true.get("contact_model") is None else true.text("contact_model"),
        _load(told.inside("load")), whole,
    )  # fmt: skip


def hand_tree(told: Told, folder: Path) -> LinkTree:
    """Return the links of the hand of an execution, whose file is the one that was planned with.

    Args:
        told: the table `execution`.
        folder: where plan.json stands.

    Raises:
        InputError: there is no such file, or it has changed.
    """
    name = told.get("hand_file")
    if not isinstance(name, str):
        raise told.refused("hand_file", "the hand comes from no file, so that its links are not known")
    path = bundled("models") / Path(name).relative_to("models") if name.startswith("models/") else folder / name
    raw = read_bytes(path, "hand file", "execution.hand_file")
    if sha256(raw).hexdigest() != told.get("sha256"):
        raise told.refused("sha256", f"'{path}' has changed since this was planned; plan again")
    return read_model(path, "execution.hand_file", told=told.texts("joints"), palm=told.text("root_link"))


def _shape(shape: Any, told: Told) -> Mapping[str, Any]:
    *names, last = GEOMS
    if shape is None:
        shapes = f"{', '.join(names)} or {last}"
        message = f"a bare mass has no surface to touch; give the object a shape ({shapes}) and plan again"
        raise told.refused("object.shape", message)
    name = next(iter(shape), "") if isinstance(shape, dict) else str(shape)
    if name in SHAPES and name not in GEOMS:
        message = f"MuJoCo does not play the shape '{name}'; it plays {', '.join(names)} and {last}"
        raise told.refused("object.shape", message)
    if name not in GEOMS:
        raise told.refused("object.shape", one_of(name, GEOMS))
    return {name: sizes_of(name, told.inside("object").inside("shape").inside(name))}


def pad_of(told: Told, origin: Array) -> Pad:
    """Return the contact that a table of `execution.contacts` tells, its point from the origin (3,) of the object."""
    kind = contact_kind(told.text("kind"), f"{told.key}.kind")
    parameters, given = told.inside("parameters"), {each.name: each.key for each in kind.parameters}
    contact = Contact(
        name=told.text("name"), kind=kind(**{name: parameters.positive(key) for name, key in given.items()}),
        point=told.array("point_m", (3,)) - origin, frame=told.array("frame", (3, 3)).T,
    )  # fmt: skip
    rows = contact.n_rows
    return Pad(
        contact, told.text("link"), told.array("pad_centre_m", (3,)), told.number("pad_radius_m"),
        told.array("compliance", (rows, rows)),
    )  # fmt: skip


def _load(told: Told) -> Load:
    times = told.array("times_s", (None,))
    parts = told.several("forces") if told.get("forces") else []
    at = np.array([part.array("at_m", (3,)) for part in parts]).reshape(-1, 3)
    forces = np.array([part.array("force", (len(times), 3)) for part in parts]).reshape(-1, len(times), 3)
    return Load(times, told.array("wrench", (len(times), 6)), frozen(at), frozen(forces.swapaxes(0, 1)))
