"""What is noted of a play: what stood in for what a plan does not tell, and where it was ended."""

from __future__ import annotations

from synergrip.simulation.played_plan import PlayedPlan
from synergrip.simulation.playing import FLOWN, Played


def notes_of(plan: PlayedPlan, found: Played, speed: str) -> tuple[str, ...]:
    """Return what else is to be known of a play."""
    model, notes = found.model, list[str]()
    if plan.unchanged is False:
        notes.append(
            "plan.json is not as it was written (its digest is another): nobody has found what it claims for the "
            "references that it has now; `synergrip check` judges it"
        )
    points = [each.pad.contact.name for each in model.pads if not each.pad.radius > 0]
    if points:
        radius = next(each.radius for each in model.pads if not each.pad.radius > 0)
        notes.append(f"pads without a radius touch with a sphere of {1e3 * radius:g} mm: {', '.join(points)}")
    if plan.mass is None:
        notes.append(f"the object has no mass in the plan; {model.mass:g} kg stand in for it")
    if model.springs.count:
        notes.append(
            f"{model.springs.count} of {len(plan.q_0)} directions of the joints do not give and are prescribed"
        )
    if speed == "real":
        notes.append("the hand's own inertia is not in plan.json; links and pads are light")
    if found.flown is not None:
        when = moment(found.flown, float(plan.times[0]))
        said = f"the object was {1e3 * FLOWN:g} mm from where it was to be {when}, and the play was ended there"
        notes.append(said)
    return tuple(notes)


def moment(time: float, start: float) -> str:
    """Return when something was, in words: at a time of the plan [s], or so long before its start."""
    return f"at {time:.4g} s" if time >= start else f"{start - time:.2g} s before the start"
