"""A grasp as its equilibrium needs it: where its pads are on their links, and how each contact moves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from synergrip.documents.judging import Arguments, is_word
from synergrip.documents.naming import naming_arguments
from synergrip.equilibrium.meeting import Model, Several, Sliding, Stuck
from synergrip.equilibrium.rolling import Rolling
from synergrip.equilibrium.states import Loads, States
from synergrip.errors import InputError, one_of
from synergrip.grasps.compliance import joint_compliance
from synergrip.grasps.contact_maps import component_places
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.held import Held
from synergrip.grasps.placing import Touch
from synergrip.grasps.scale import scale_of
from synergrip.linalg import Array, Places
from synergrip.statics.motion import forces_at_start
from synergrip.statics.response import Response, respond
from synergrip.values import Value

ContactModel = Literal["rolling", "fixed"]
MODELS = ("rolling", "fixed")
Kind = Literal["rolling", "sliding", "stuck"]


@dataclass(frozen=True, eq=False, repr=False)
class Setting(Value):
    """A grasp at its start, and the model of each of its contacts."""

    grasp: Grasp
    held: Held
    forces: Array  # (n_l,) lambda_0 [N, N m]
    model: Model
    """How the contacts move."""
    points: tuple[tuple[str, Array], ...]
    """The point of a link that each contact is about: link, and (3,) in its coordinates [m]."""
    links: Array  # (n_c, 3, 3) rotations of the links at the start
    rolls: tuple[bool, ...]
    """Which contacts roll."""
    early: Array | float = 0.0
    """(n_l,) by how much springs of contacts are stretched beyond what links and object say [m, rad]: along the normal
    of a contact that meets the object early, and below 0 of one that is late; 0 where all are in place."""

    @property
    def contact_model(self) -> str:
        """The word for it: "rolling" when any contact rolls, else "fixed"."""
        return "rolling" if any(self.rolls) else "fixed"

    @cached_property
    def start(self) -> States:
        """The state at the start."""
        held = self.held
        return States(
            np.array(held.q)[None], np.array(held.body.position)[None], np.eye(3)[None], np.array(self.forces)[None]
        )

    def unloaded(self, loads: Loads) -> Loads:
        """Return (1) the load at the start, with the points of other loads."""
        return Loads(np.array(self.grasp.w_0)[None], loads.points, np.zeros((1, *loads.at_points.shape[1:])))

    @cached_property
    def compliance(self) -> Array:
        """(n_q, n_q) of the joints with the synergies behind them: C_q + S C_z S'."""
        return joint_compliance(self.grasp.C_q, self.grasp.S, self.grasp.C_z)

    @cached_property
    def components(self) -> Places:
        """(n_l,) the place of each force component among n, t, o and the moments about them of all contacts (6 n_c)."""
        return component_places(self.grasp.contacts)

    @cached_property
    def torques(self) -> Array:
        """(n_q,) tau_0 at the start."""
        return np.asarray(self.grasp.J.T @ self.forces)

    @cached_property
    def length(self) -> float:
        """Characteristic length of the grasp [m]."""
        return scale_of(self.grasp).length

    @cached_property
    def turning(self) -> Array:
        """(n_c, n_q) 1 where a joint that turns carries the link of a contact."""
        held, start = self.held, self.start.q
        turns = np.array([joint.kind == "hinge" for joint in held.hand.joints])
        jacobian = held.hand.kinematics.along(start, self.points).jacobian[0, :, 1]
        return np.asarray(np.any(jacobian != 0, axis=1) & turns, dtype=float)

    @cached_property
    def above(self) -> Array:
        """(n_q, n_q) 1 where joint i carries joint j, or is joint j."""
        hand = self.held.hand
        carried = [set(hand.carriers(joint.link)) if joint.link else set() for joint in hand.joints]
        return np.array([[float(i == j or one.link in carried[j]) for j in range(len(carried))]
                         for i, one in enumerate(hand.joints)])  # fmt: skip


@naming_arguments
def setting(grasp: Grasp, contact_model: ContactModel = "rolling", response: Response | None = None) -> Setting:
    """Return what the equilibrium of a grasp is made of.

    Args:
        grasp: on a hand.
        contact_model: "rolling": pads with a radius roll on objects with a shape, but for patches, which lie flat;
            "fixed": all contacts stay where they are on link and object. Contacts without friction slide in both.
        response: of the grasp, when it is known.

    Raises:
        InputError: no grasp, one given as matrices, which has no kinematics; no such model; no response.
    """
    judge = Arguments("")
    judge.one("grasp", grasp, Grasp, "the one that make_grasp returns")
    if not is_word(contact_model, MODELS):
        judge.refuse("contact_model", one_of(contact_model, MODELS))
    if response is not None:
        judge.one("response", response, Response, "respond(grasp)")
    judge.finish()
    if response is not None and response.grasp != grasp:
        raise InputError.at("response", "is of another grasp; write respond(grasp), or leave it out")
    held = grasp.held
    if held is None:
        raise InputError.at("grasp", "a grasp given as matrices has no kinematics; make_grasp makes one on a hand")
    start = forces_at_start(respond(grasp) if response is None else response)
    motions = held.hand.kinematics.at(held.q, [(touch.pad.link, touch.pad.point) for touch in held.touches])
    pads = np.array([motion.position for motion in motions]) - held.body.position
    kinds = [
        _kind(contact, touch, held, contact_model) for contact, touch in zip(grasp.contacts, held.touches, strict=True)
    ]
    stuck = np.array([kind == "stuck" for kind in kinds])
    about = np.where(stuck[:, None], np.array([contact.point for contact in grasp.contacts]), pads)
    points = tuple(
        (touch.pad.link, motion.rotation.T @ (point - pad) + touch.pad.point)
        for touch, motion, point, pad in zip(held.touches, motions, about, pads, strict=True)
    )
    links = np.array([motion.rotation for motion in motions])
    rolls = tuple(kind == "rolling" for kind in kinds)
    return Setting(grasp, held, start, _model(grasp, held, kinds, about), points, links, rolls)


def _kind(contact: Contact, touch: Touch, held: Held, contact_model: ContactModel) -> Kind:
    """Return how a contact moves.

    One that transmits moments about its tangents lies flat, and stays so until it tips: no part of it lifts off, as the
    rear of a tip that rolls does, and what turns the link against the object bends its springs.
    """
    shape, kind = held.body.shape, contact.kind
    if shape is not None and kind.components == ("n",):
        return "sliding"
    rolls = shape is not None and touch.pad.radius and contact_model == "rolling" and touch.normals == "object"
    return "rolling" if rolls and not kind.lies_flat else "stuck"


def _model(grasp: Grasp, held: Held, kinds: Sequence[Kind], points: Array) -> Model:
    """Return the model of contacts of some kinds about points (n_c, 3), from B."""
    shape, parts = held.body.shape, list[tuple[Places, Model]]()
    frames = np.array([contact.frame for contact in grasp.contacts])
    for kind in dict.fromkeys(kinds):
        own = np.array([i for i, each in enumerate(kinds) if each == kind])
        if shape is None or kind == "stuck":
            turns = any(len(grasp.contacts[i].kind.components) > 3 for i in own)
            model: Model = Stuck(points[own], frames[own], turns)
        elif kind == "rolling":
            model = Rolling.at_start(shape, points[own], frames[own])
        else:
            model = Sliding(shape, shape.surface(points[own])[0])
        parts.append((own, model))
    return parts[0][1] if len(parts) == 1 else Several(tuple(parts))
