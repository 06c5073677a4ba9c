"""Whether values are written in the units of what they are for: joints turn or slide, and so do synergies."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace

from synergrip.documents.fields import Measured
from synergrip.documents.quantities import EXAMPLES
from synergrip.documents.validation import shown
from synergrip.errors import Issue
from synergrip.hands.hand import Joint, SynergySet

SLIDE_KINDS = {"angle": "length", "torque": "force", "joint compliance": "slide compliance"}
"""Kind of a quantity of a hinge -> kind of the same of a slide."""
SI_UNITS = {"hinge": "rad", "slide": "m"}
"""Kind of a joint -> unit of its value."""
_HINGE_KINDS = {slide: hinge for hinge, slide in SLIDE_KINDS.items()}
_DOES = {
    "joint": {"hinge": "turns", "slide": "slides"},
    "synergy": {"hinge": "moves joints that turn", "slide": "moves only joints that slide"},
}


def joint_kinds(joints: Sequence[Joint]) -> dict[str, str]:
    """Return the kind, "hinge" or "slide", of each joint by name."""
    return {joint.name: joint.kind for joint in joints}


def synergy_kinds(synergies: SynergySet, joints: Iterable[str]) -> dict[str, str]:
    """Return the kind of each synergy by name: "slide" if its column of S moves slides only, else "hinge".

    Args:
        synergies: the set.
        joints: the kind of each joint, in the order of q.
    """
    kinds = tuple(joints)
    moved = [{kind for kind, weight in zip(kinds, column, strict=True) if weight} for column in synergies.S.T]
    return {
        name: "slide" if each == {"slide"} else "hinge" for name, each in zip(synergies.synergies, moved, strict=True)
    }


def unit_of(joints: Iterable[str], hinge: str, slide: str) -> str:
    """Return the unit that suits joints of these kinds, or no unit when some turn and some slide."""
    kinds = set(joints)
    return {"hinge": hinge, "slide": slide}[kinds.pop()] if len(kinds) == 1 else ""


def torque_unit(joints: Collection[str]) -> str:
    """Return the unit of the torques of joints of these kinds; N m where no kind is known, as in a grasp file."""
    return unit_of(joints, "N m", "N") if joints else "N m"


def misfits(values: Iterable[tuple[str, str, float]], kinds: Mapping[str, str], what: str = "joint") -> list[Issue]:
    """Return one issue for each value that is written in a unit of the other kind.

    Args:
        values: the key of each value, the name of what it is for, and the value. A plain number has no unit and is
            not judged; neither is a value for a name that `kinds` does not have.
        kinds: "hinge" or "slide" by name.
        what: "joint" or "synergy".
    """
    issues = []
    for key, name, value in values:
        kind = kinds.get(name, "")
        other = _HINGE_KINDS if kind == "hinge" else SLIDE_KINDS
        if kind and isinstance(value, Measured) and value.kind in other:
            wanted = other[value.kind]
            message = (
                f"{what} '{name}' {_DOES[what][kind]}: write {_article(wanted)} such as '{EXAMPLES[wanted]}', "
                f"not {shown(value.text)}"
            )
            issues.append(Issue(message, key=key))
    return issues


def list_misfits(
    key: str, value: float | Sequence[float], kinds: Mapping[str, str], what: str = "joint"
) -> list[Issue]:
    """Return the issues of a list with one value for each name at ``key[i]``, or that of one value for all at `key`."""
    if isinstance(value, Sequence):
        return misfits(
            [(f"{key}[{i}]", name, each) for i, (name, each) in enumerate(zip(kinds, value, strict=True))], kinds, what
        )
    issues = misfits([(key, name, value) for name in kinds], kinds, what)[:1]
    if len(set(kinds.values())) > 1:
        return [replace(issue, message=f"{issue.message}; some turn, some slide: give a list") for issue in issues]
    return issues


def _article(kind: str) -> str:
    return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind}"
