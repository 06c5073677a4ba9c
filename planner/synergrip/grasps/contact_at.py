"""Where a hand is to touch, and how: what a user says of a contact before anybody knows where the object is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, field
from typing import ClassVar, Literal

import numpy as np

from synergrip.documents.judging import Arguments, described, is_word
from synergrip.documents.naming import naming_arguments
from synergrip.errors import one_of
from synergrip.grasps.contacts.kind import EXAMPLE_OF, ContactKind
from synergrip.linalg import Array, frozen
from synergrip.values import Kept

SOFTEST = 1e-6
"""A contact that yields a kilometre under a millinewton holds nothing [N/m, N m/rad]."""


@naming_arguments
@dataclass(frozen=True)
class LinkPlace(Kept):
    """A place on a link, in its frame.

    Args:
        link: name of the link.
        point: (3,) [m]; the origin of the link when absent.
        normal: (3,) direction in which it pushes, of any length; None for toward the object.
        radius: of a round pad about the place [m].

    Raises:
        InputError: a value that is none.

    Example:
        >>> LinkPlace("finger1_tip", point=(0.0, 0.0, 0.002), normal=(0, 0, 2)).normal
        (0.0, 0.0, 1.0)
    """

    link: str
    point: tuple[float, ...] = (0.0, 0.0, 0.0)
    normal: tuple[float, ...] | None = None
    radius: float = 0.0

    def __post_init__(self) -> None:
        """Judge the values, and make the normal a unit vector."""
        judge = Arguments("LinkPlace")
        judge.text("link", self.link, empty=False)
        object.__setattr__(self, "point", tuple(judge.array("point", self.point, (3,)).tolist()))
        if self.normal is not None:
            object.__setattr__(self, "normal", _direction(judge, "normal", self.normal))
        object.__setattr__(self, "radius", judge.number("radius", self.radius, at_least=0, unit="m"))
        judge.finish()


@naming_arguments
@dataclass(frozen=True)
class ContactAt(Kept):
    """A contact of a hand: which pad or place touches, of which kind the contact is, how stiff.

    Args:
        at: name of a pad of the hand, or a place on a link.
        kind: such as ``HardFinger(friction=0.6)``.
        stiffness: along the normal [N/m]; infinity when rigid.
        tangential_stiffness: across the normal [N/m]; as along it when absent.
        spin_stiffness: about the normal [N m/rad], for kinds that carry a moment about it.
        tilt_stiffness: about the tangents [N m/rad], for kinds that carry moments about them.
        normals: contact normal from the "object" or straight out of the "pad"; that of the object's surface where there
            is one when absent.
        tangent: (3,) direction that the t of the contact frame follows, in the frame of the link; chosen when absent.
        name: of the contact; that of the pad or link when absent.
        key: of the file that names the pad or link, for errors; empty in code.
        normal_at: where a file states the normal, for advice; empty in code.

    Raises:
        InputError: a value that is none, a stiffness that the kind needs or refuses.

    Example:
        >>> from synergrip.grasps.contacts.hard_finger import HardFinger
        >>> ContactAt("finger1/tip", HardFinger(friction=0.6), stiffness=8e3).name
        'finger1/tip'
    """

    at: str | LinkPlace
    kind: ContactKind
    _: KW_ONLY
    stiffness: float | None = None
    tangential_stiffness: float | None = None
    spin_stiffness: float | None = None
    tilt_stiffness: float | None = None
    normals: Literal["object", "pad"] | None = None
    tangent: tuple[float, ...] | None = None
    name: str = ""
    _elsewhere: ClassVar[Mapping[str, str]] = {"friction": "it is the kind's: kind=HardFinger(friction=...)"}
    key: str = field(default="", compare=False)
    normal_at: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        """Judge the values and fill in those that follow from others."""
        judge = Arguments("ContactAt")
        if not isinstance(self.at, LinkPlace) and not (isinstance(self.at, str) and self.at):
            judge.refuse("at", f"expected the name of a pad or a LinkPlace, got {described(self.at)}")
        for word in ("name", "key", "normal_at"):
            judge.text(word, getattr(self, word))
        if judge.one("kind", self.kind, ContactKind, "HardFinger(friction=0.6)") is not None:
            for name in EXAMPLE_OF:
                object.__setattr__(self, name, self._judged(judge, name))
            if self.tangential_stiffness is None and "tangential_stiffness" in self.kind.stiffnesses():
                object.__setattr__(self, "tangential_stiffness", self.stiffness)
        if self.normals is not None and not is_word(self.normals, ("object", "pad")):
            judge.refuse("normals", one_of(self.normals, ("object", "pad")))
        if self.tangent is not None:
            object.__setattr__(self, "tangent", _direction(judge, "tangent", self.tangent))
        judge.finish()
        object.__setattr__(self, "name", self.name or (self.at.link if isinstance(self.at, LinkPlace) else self.at))

    @property
    def stiffnesses(self) -> Mapping[str, float]:
        """The entries of stiffness that its kind takes [N/m, N m/rad]."""
        return {name: getattr(self, name) for name in self.kind.stiffnesses()}

    def _judged(self, judge: Arguments, name: str) -> float | None:
        value, needed = getattr(self, name), name in self.kind.stiffnesses()
        unit = "N m/rad" if name in ("spin_stiffness", "tilt_stiffness") else "N/m"
        if not needed:
            if value is not None and name not in ("stiffness", "tangential_stiffness"):
                judge.refuse(name, f"a {self.kind.name} contact has no {name.replace('_', ' ')}; leave it out")
            return None
        if value is None:
            if name != "tangential_stiffness":  # which follows from the other
                judge.refuse(name, f"missing; a {self.kind.name} contact needs it, in {unit}; math.inf when rigid")
            return None
        return judge.number(name, value, at_least=SOFTEST, unit=unit, infinite=True)


def direction_of(values: tuple[float, ...] | None) -> Array | None:
    """Return a direction as an array."""
    return None if values is None else frozen(values)


def _direction(judge: Arguments, name: str, value: object) -> tuple[float, ...]:
    found = judge.array(name, value, (3,))
    length = float(np.linalg.norm(found))
    if not length > 0:
        if not judge.issues:
            judge.refuse(name, "must not be zero")
        return (0.0, 0.0, 1.0)
    return tuple((found if abs(length - 1) < 1e-12 else found / length).tolist())
