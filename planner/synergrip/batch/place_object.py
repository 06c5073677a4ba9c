"""From a hand that closes and an object without a place to the grasp at the best one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from synergrip.batch.best_place import best_place
from synergrip.batch.placed_object import PlacedObject
from synergrip.batch.telling import Progress, judge_progress
from synergrip.documents.judging import Arguments
from synergrip.documents.naming import naming_arguments
from synergrip.grasps.asked_grasp import asked_grasp, grasp_of
from synergrip.grasps.asked_hand import Posture, Synergies
from synergrip.grasps.contact_at import ContactAt
from synergrip.grasps.objects import Object
from synergrip.hands.hand import Hand
from synergrip.linalg import Array
from synergrip.tasks.task import Task


@naming_arguments
def place_object(
    hand: Hand | str | Path,
    object: Object,
    *,
    posture: Posture,
    contacts: Sequence[ContactAt],
    close: str | Mapping[str, float],
    task: Task,
    synergies: Synergies | None = None,
    joint_compliance: float | Sequence[float] | Array | None = None,
    synergy_compliance: float | Sequence[float] | Array = 0.0,
    title: str = "",
    relative_to: str | Path | None = None,
    progress: Progress | None = None,
) -> PlacedObject:
    """Return where an object is held best by a hand that closes on it, and the grasp there.

    Places all over the space that the pads sweep are closed on at once. Where all contacts touch, the largest slip
    margin at the task's load is worked out by `plan_many`, with the limits of the task on forces, torques, efforts,
    references and joint ranges (no others count); around the best ones it is looked again, as long as that gains, until
    places are 1 mm apart. A place at which the skeleton of the hand runs through the object, or a contact is at an edge
    of it, goes after others, and one at which the skeleton is more than 3 mm inside after all others. Then `plan` is
    asked: the first of up to 16 places, best first and far from each other, at which the whole task has a plan is
    taken, else the best one. The same question has the same answer, unless planning takes longer than a minute, after
    which no further place is planned at.

    Args:
        hand: as of `make_grasp`, and so are the other arguments that it has.
        object: with a shape; its position, if it has one, does not count.
        posture: an open one, from which the hand closes.
        contacts: all of which are to touch.
        close: the synergy, joint or weights by name along which the hand closes.
        task: whose load is to be held, at up to five of its knots, and which is planned at the best places.
        synergies: as of `make_grasp`.
        joint_compliance: as of `make_grasp`.
        synergy_compliance: as of `make_grasp`.
        title: of the grasp.
        relative_to: folder of a synergy file.
        progress: told what is under way and which share of it is done.

    Raises:
        InputError: arguments as of `make_grasp`; no place at which all contacts touch, with the nearest one and how far
            pads are away there.

    Example:
        >>> from synergrip import Gravity, HardFinger, NormalForce, Sphere
        >>> tips = [f"finger{i}/tip" for i in (1, 2, 3)]
        >>> found = place_object(
        ...     "barrett", Object(mass=0.2, shape=Sphere(radius=0.05)), posture="open", close="close",
        ...     contacts=[ContactAt(tip, HardFinger(friction=0.6), stiffness=8e3) for tip in tips],
        ...     task=Task(loads=[Gravity((0, 0, -9.81))], limits=[NormalForce(upper=20.0)]),
        ... )
        >>> found.margin > 1, found.grasp.n_c, found.outcome.verdict
        (True, 3, 'feasible')
    """
    judge = Arguments("")
    judge.one("task", task, Task, "Task(loads=[Gravity((0, 0, -9.81))])")
    judge.finish()
    judge_progress(progress)
    asked = asked_grasp(
        hand, object, posture=posture, contacts=contacts, synergies=synergies, close=close, title=title,
        joint_compliance=joint_compliance, synergy_compliance=synergy_compliance, relative_to=relative_to,
        anywhere=True,
    )  # fmt: skip
    return best_place(asked, lambda position: (grasp_of(asked.at(position)), task), progress)
