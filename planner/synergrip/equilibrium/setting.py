"""A grasp as its equilibrium needs it: where its pads are on their links, and how each contact moves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from synergrip.documents.judging import Arguments, is_word
from synergrip.documents.naming import naming_arguments
from synergrip.equilibrium.meeting import Model, Rolling, Sliding, Stuck
from synergrip.equilibrium.states import Loads, States
from synergrip.errors import InputError, one_of
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.held import Held
from synergrip.grasps.placing import Touch
from synergrip.grasps.scale import scale_of
from synergrip.linalg import Array
from synergrip.statics.motion import forces_at_start
from synergrip.statics.response import Response, respond
from synergrip.values import Value

ContactModel = Literal["rolling", "fixed"]
MODELS = ("rolling", "fixed")


@dataclass(frozen=True, eq=False, repr=False)
class Setting(Value):
    """A grasp at its start, and the model of each of its contacts."""

    grasp: Grasp
    held: Held
    forces: Array  # (n_l,) lambda_0 [N, N m]
    models: tuple[Model, ...]
    points: tuple[tuple[str, Array], ...]
    """The point of a link that each contact is about: link, and (3,) in its coordinates [m]."""
    links: Array  # (n_c, 3, 3) rotations of the links at the start
    contact_model: str
    """"rolling" when any contact rolls, else "fixed"."""

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
        grasp = self.grasp
        return np.asarray(grasp.C_q + grasp.S @ grasp.C_z @ grasp.S.T)

    @cached_property
    def torques(self) -> Array:
        """(n_q,) tau_0 at the start."""
        return np.asarray(self.grasp.J.T @ self.forces)

    @cached_property
    def length(self) -> float:
        """Characteristic length of the grasp [m]."""
        return scale_of(self.grasp).length

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
        contact_model: "rolling": pads with a radius roll on objects with a shape; "fixed": all contacts stay where they
            are on link and object. Contacts without friction slide in both.
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
    held = grasp.held
    if held is None:
        raise InputError.at("grasp", "a grasp given as matrices has no kinematics; make_grasp makes one on a hand")
    start = forces_at_start(respond(grasp) if response is None else response)
    motions = held.hand.kinematics.at(held.q, [(touch.pad.link, touch.pad.point) for touch in held.touches])
    models, points = list[Model](), list[tuple[str, Array]]()
    for contact, touch, motion in zip(grasp.contacts, held.touches, motions, strict=True):
        model, point = _model(contact, touch, held, motion.position - held.body.position, contact_model)
        local = motion.rotation.T @ (point + held.body.position - motion.position) + touch.pad.point
        models.append(model)
        points.append((touch.pad.link, local))
    rolls = any(isinstance(model, Rolling) for model in models)
    links = np.array([motion.rotation for motion in motions])
    return Setting(grasp, held, start, tuple(models), tuple(points), links, "rolling" if rolls else "fixed")


def _model(contact: Contact, touch: Touch, held: Held, pad: Array, contact_model: ContactModel) -> tuple[Model, Array]:
    """Return the model of a contact, and the point that it is about, from B; `pad` (3,) is where the pad is."""
    shape, kind = held.body.shape, contact.kind
    if shape is not None and kind.components == ("n",):
        return Sliding(shape, shape.surface(pad)[0]), pad
    if shape is not None and touch.pad.radius and contact_model == "rolling" and touch.normals == "object":
        return Rolling.at_start(shape, pad, contact.frame), pad
    return Stuck(contact.point, contact.frame, len(kind.components) > 3), contact.point
