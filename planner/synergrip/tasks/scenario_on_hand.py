"""A random sample of a grasp on a hand: pads that touch elsewhere, normals that are tilted, other compliances.

Hand and object are where they are stated. A pad that touches the object elsewhere on its surface does so with another
point of its link, at the same place, so that its force acts there on both. What the contacts are squeezed by at the
start is in balance with the load there: the elastic reaction of the sample to it, and what was squeezed in.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.sampled import started
from synergrip.equilibrium.meeting import on_face
from synergrip.equilibrium.rolling import carried_along
from synergrip.equilibrium.setting import Setting, setting
from synergrip.equilibrium.tilted import Tilted
from synergrip.errors import SynergripError
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp, grasp_matrix, hand_jacobian
from synergrip.grasps.placing import Touch, moved_to
from synergrip.grasps.shapes.shape import Shape
from synergrip.hands.point_motion import PointMotion
from synergrip.linalg import Array, frozen
from synergrip.statics import respond
from synergrip.values import Value

COMPLIANCES = ("C_s", "C_q", "C_z")


@dataclass(frozen=True, eq=False, repr=False)
class Errors(Value):
    """What is off in one sample."""

    shifts: Array  # (n_c, 2) of the contacts along t and o [m]
    turns: Array  # (n_c, 3, 3) of their frames, in the axes of each
    factors: tuple[float, ...]
    """Of C_s, C_q and C_z."""


class OffTheFaceError(SynergripError):
    """A contact would be beyond the edge of its face."""


def sample_of(grasp: Grasp, errors: Errors) -> Setting:
    """Return a grasp on a hand with some errors, as its equilibrium needs it.

    Args:
        grasp: on a hand.
        errors: of its contacts and compliances.

    Raises:
        OffTheFaceError: a contact would be beyond the edge of its face.
    """
    held = grasp.held
    assert held is not None
    pads = [(touch.pad.link, touch.pad.point) for touch in held.touches]
    motions = held.hand.kinematics.at(held.q, pads)
    places = zip(grasp.contacts, held.touches, motions, errors.shifts, strict=True)
    moved = [_elsewhere(contact, touch, motion, held.body.position, held.body.shape, shift)
             for contact, touch, motion, shift in places]  # fmt: skip
    level = tuple(contact for contact, _ in moved)
    tilted = tuple(
        replace(contact, frame=frozen(contact.frame @ turn)) for contact, turn in zip(level, errors.turns, strict=True)
    )
    jacobians = [moved_to(motion, contact.point + held.body.position).jacobian
                 for motion, contact in zip(motions, level, strict=True)]  # fmt: skip
    soft = {name: factor * getattr(grasp, name) for name, factor in zip(COMPLIANCES, errors.factors, strict=True)}
    found = replace(
        grasp, contacts=level, G=grasp_matrix(tilted), J=hand_jacobian(tilted, jacobians), lambda_0=None, **soft,
        held=replace(held, touches=tuple(touch for _, touch in moved)),
    )  # fmt: skip
    response = respond(found)
    own = setting(found, "rolling", response)
    forces = started(response, grasp.lambda_0)
    return replace(own, grasp=replace(found, contacts=tilted), forces=forces, model=Tilted(own.model, errors.turns))


def _elsewhere(
    contact: Contact, touch: Touch, motion: PointMotion, origin: Array, shape: Shape | None, shift: Array
) -> tuple[Contact, Touch]:
    """Return a contact and its pad shifted (2,) along t and o, on the surface of the object and as far from it.

    Without a shape the surface is the plane across the normal. The frame is carried along where it is that of the
    surface.

    Raises:
        OffTheFaceError: there is an edge between.
    """
    centre, off = motion.position - origin, contact.frame[:, 1:] @ shift
    if shape is None:
        moved, arm, frame = centre + off, contact.point - centre, contact.frame
    else:
        distance, outward = shape.surface(centre)
        depth, there = shape.surface(beside := centre - distance * outward + off)
        spot = beside - depth * there
        if on_face(shape, spot[None, None], np.zeros((1, 1)), there[None, None])[0] < 1:
            raise OffTheFaceError(f"contact '{contact.name}' is beyond the edge of its face")
        moved, turn = spot + distance * there, carried_along(outward, there)
        arm = turn @ (contact.point - centre)
        frame = turn @ contact.frame if touch.normals == "object" else contact.frame
    pad = replace(touch.pad, point=frozen(touch.pad.point + motion.rotation.T @ (moved - centre)))
    return replace(contact, point=frozen(moved + arm), frame=frozen(frame)), replace(touch, pad=pad)
