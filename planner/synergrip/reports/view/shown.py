"""What a live view begins with: a hand by itself, or with what a problem wants it to hold."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.errors import InputError
from synergrip.grasps.asked_grasp import AskedGrasp
from synergrip.grasps.closing import close
from synergrip.grasps.held import Held
from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.spots import rest_posture
from synergrip.hands.synergies.matrix import posture as posture_named
from synergrip.linalg import Array, frozen
from synergrip.reports.view.posed import Posed, middle_of
from synergrip.reports.view.posing import Posing, only_joints
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Shown(Value):
    """What is posed, how it begins, and what can be done to it."""

    posed: Posed
    begin: Posing
    sets: Mapping[str, SynergySet]
    """Synergy sets by name, the one it begins with first, without those that are the joints themselves."""
    closed: Callable[[Array], Array] | None = None
    """The posture (n_q,) of the hand closed on the object at a position (3,); None where it does not close."""
    title: str = ""
    notes: tuple[str, ...] = ()


def hand_shown(hand: Hand, posture: str | Mapping[str, float] | None = None) -> Shown:
    """Return a hand by itself, at rest, in a named posture, or at values [rad or m] by synergy or joint.

    Raises:
        InputError: a posture that it has not or cannot take, at ``--posture``.
    """
    sets = _beside_joints(hand, hand.synergy_sets)
    synergies = next(iter((sets or hand.synergy_sets).values()))
    q = rest_posture(hand) if posture is None else posture_named(hand, synergies, posture, "--posture")
    posed = Posed(hand)
    notes = () if hand.pads else ("the hand has no pads; a problem puts contacts on its links",)
    return Shown(posed, Posing.at(hand, synergies, q, middle_of(posed, q)), sets, title=hand.title, notes=notes)


def problem_shown(
    asked: AskedGrasp, held: Held | None, gravity: Sequence[float] | None, refused: Sequence[str] = ()
) -> Shown:
    """Return the hand of a problem with its object.

    Args:
        asked: hand, object and contacts.
        held: where all of it is when the contacts touch; else None, and the object stays where it is said to be, or
            between the pads.
        gravity: (3,) in the palm frame at the start [m/s^2].
        refused: why the contacts do not touch.
    """
    down = None if gravity is None else frozen(np.array(gravity, dtype=float))
    notes, body, q = list(refused), asked.body, asked.q
    posed = Posed(asked.hand, body, asked.touches, down)
    if held is not None:
        q, body = held.q, held.body
    elif not body.placed:
        body = replace(body, position=frozen(middle_of(posed, q)))
        notes.append("nobody knows where the object is: it is drawn in the middle of the pads")
    elif asked.closing is not None:
        notes.append("the hand is drawn before it closes")
    notes += held.notes if held is not None else ()
    every = {asked.synergies.name: asked.synergies, **asked.hand.synergy_sets}
    sets = _beside_joints(asked.hand, every | {asked.synergies.name: asked.synergies})
    begin = Posing.at(asked.hand, next(iter(sets.values()), asked.synergies), q, body.position)
    return Shown(posed, begin, sets, _closing(asked), asked.title, tuple(notes))


def _beside_joints(hand: Hand, sets: Mapping[str, SynergySet]) -> Mapping[str, SynergySet]:
    """Return the sets without those whose synergies are the joints, which have dials of their own."""
    return {name: each for name, each in sets.items() if not only_joints(hand, each)}


def _closing(asked: AskedGrasp) -> Callable[[Array], Array] | None:
    if asked.closing is None or asked.body.shape is None:
        return None
    direction = asked.closing
    return lambda position: close(asked.hand, asked.q, direction, asked.at(frozen(position)).body, asked.touches)


def reasons(error: InputError) -> list[str]:
    """Return what an error says, an issue each."""
    return [f"{issue.key}: {issue.message}" if issue.key else issue.message for issue in error.issues]
