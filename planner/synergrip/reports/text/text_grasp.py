"""A hand that holds an object, as text: posture, object, contacts."""

from __future__ import annotations

from collections.abc import Iterator

from synergrip.documents.quantities import SHOWN_IN, in_g, plain
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.held import Held
from synergrip.hands.hand import Hand
from synergrip.hands.spots import spots_of
from synergrip.hands.units import SI_UNITS
from synergrip.linalg import Array
from synergrip.problems.in_short import many
from synergrip.problems.problem import Problem
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_spots import spots_table, triple
from synergrip.reports.text.unbroken import TIED

HEADER = ("contact", "link", "kind", "point [mm]", "normal", "gap [mm]", "friction")


def in_order_text(problem: Problem) -> str:
    """Return what a problem in order holds: counts; with a hand its posture, the object and the contacts; notes."""
    grasp = problem.grasp
    counts = {"contact": grasp.n_c, "joint": grasp.n_q, "synergy": grasp.n_z, "knot": len(problem.timed.times)}
    told = ", ".join(many(count, noun) for noun, count in counts.items())
    place, counted = (words.replace(" ", TIED) for words in (str(problem.path), f"({told})"))
    lines = wrapped("", f"{place}: in order {counted}", inset=2)
    if problem.held is not None:
        lines += ["", *_held_lines(problem.held, grasp)]
    lines += [line for note in problem.notes for line in wrapped("note     ", note)]
    return "\n".join(lines)


def _held_lines(held: Held, grasp: Grasp) -> Iterator[str]:
    yield from posture_lines(held.hand, held.q)
    body = held.body
    mass = f", {in_g(body.mass)}" if body.mass else ""
    titles = dict.fromkeys([body.title, *([body.shape.title] if body.shape else [])])
    where = f"centre {triple(1e3 * body.position, 4)} mm in the palm frame"
    yield from wrapped("object   ", f"{', '.join(titles)}{mass}, {where}")
    yield ""
    rows = [
        (
            contact.name, touch.pad.link, contact.kind.name, triple(1e3 * (contact.point + body.position), 4),
            triple(contact.frame[:, 0], 3), "" if gap is None else f"{round(1e3 * gap, 3) + 0.0:.3f}",
            f"{contact.friction:.4g}",
        )
        for contact, touch, gap in zip(grasp.contacts, held.touches, held.gaps, strict=True)
    ]  # fmt: skip
    yield table(HEADER, rows, right=(5, 6))
    touching = [touch.pad for touch in held.touches]
    named = {(pad.link, pad.name) for pad in touching}
    others = [spot for spot in spots_of(held.hand, held.q, touching) if (spot.link, spot.name) not in named]
    if others:
        yield ""
        yield spots_table(others, "other pad" if all(spot.pad for spot in others) else "no contact at")


def posture_lines(hand: Hand, q: Array) -> Iterator[str]:
    """Yield the joint values (n_q,) of a posture."""
    values = [f"{joint.name} {_value(joint.kind, value)}" for joint, value in zip(hand.joints, q, strict=True)]
    yield from wrapped("posture  ", " · ".join(value.replace(" ", TIED) for value in values))


def _value(kind: str, q: float) -> str:
    """Return a joint value in the unit people use."""
    factor, unit = SHOWN_IN[SI_UNITS[kind]]
    return f"{plain(round(factor * q, 6) + 0.0)} {unit}"
