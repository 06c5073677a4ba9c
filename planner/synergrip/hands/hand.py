"""What the robot is: joints, compliance, synergies, pads. The paper's left-hand side of (9) and (10)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from synergrip.documents.judging import Arguments
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, one_of
from synergrip.hands.drives import Drives
from synergrip.hands.point_motion import Kinematics, PointMotion
from synergrip.linalg import Array
from synergrip.values import ByContent, ByName, Kept, same

UNIT = 1e-6
"""How far the length of the normal of a pad may be from 1."""


@naming_arguments
@dataclass(frozen=True, kw_only=True)
class Joint(Kept):
    """One joint, in the order of q."""

    name: str
    kind: str
    """"hinge" (rad, N m) or "slide" (m, N)."""
    lower: float = -math.inf  # [rad] or [m]
    upper: float = math.inf  # [rad] or [m]
    torque_limit: float = math.inf
    """|tau| allowed [N m] or [N]; infinity when the hand states none."""
    link: str = ""
    """The link that it turns or shifts."""
    place: str = field(default="", compare=False)
    """File and line that state the range, for messages."""

    def __post_init__(self) -> None:
        """Judge the values.

        Raises:
            InputError: a name that is none, an unknown kind, a range that is none, a limit not above 0.
        """
        judge = Arguments("Joint")
        judge.text("name", self.name, empty=False)
        if self.kind not in ("hinge", "slide"):
            judge.refuse("kind", one_of(self.kind, ("hinge", "slide")))
        lower, upper = (judge.number(end, getattr(self, end), infinite=True) for end in ("lower", "upper"))
        limit = judge.number("torque_limit", self.torque_limit, above=0, infinite=True)
        if not judge.issues and lower > upper:
            judge.refuse("upper", f"must not be below lower, got {upper:g} and {lower:g}")
        judge.finish()
        for name, value in (("lower", lower), ("upper", upper), ("torque_limit", limit)):
            object.__setattr__(self, name, value)


@naming_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Pad(ByContent):
    """A place on a link that is made to touch things."""

    name: str
    link: str
    point: Array
    """(3,) in link coordinates [m]."""
    normal: Array
    """(3,) unit outward normal in link coordinates: the direction in which the pad pushes; 0 for toward the object."""
    radius: float = 0.0
    """[m] of a round pad with its centre at `point`, which touches where the object is nearest; 0 for the point."""

    def __post_init__(self) -> None:
        """Judge the values.

        Raises:
            InputError: names that are none, a point or normal of other than three finite numbers, a negative radius.
        """
        judge = Arguments("Pad")
        for name in ("name", "link"):
            judge.text(name, getattr(self, name), empty=False)
        point, normal = (judge.array(name, getattr(self, name), (3,)) for name in ("point", "normal"))
        radius, size = judge.number("radius", self.radius, at_least=0, unit="m"), float(np.linalg.norm(normal))
        if not judge.issues and size and abs(size - 1) > UNIT:
            judge.refuse("normal", f"expected a unit vector, or zeros for toward the object; got length {size:.9g}")
        judge.finish()
        for name, value in (("point", point), ("normal", normal), ("radius", radius)):
            object.__setattr__(self, name, value)


@naming_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class SynergySet(ByContent):
    """A named synergy matrix S (9)."""

    name: str
    title: str = ""
    synergies: tuple[str, ...]
    """Name of each column."""
    S: Array  # (n_q, n_z)
    offset: Array = None  # type: ignore[assignment]
    """(n_q,) joint values at z = 0: q = S z + offset; 0 when absent."""
    effort_limits: Array = None  # type: ignore[assignment]
    """(n_z,) |sigma| allowed; infinity where the hand states none."""

    def __post_init__(self) -> None:
        """Judge the values.

        Raises:
            InputError: names that are none or stand twice, shapes that do not fit, numbers that are not finite.
        """
        judge = Arguments("SynergySet")
        judge.text("name", self.name)
        n_q, n_z = np.shape(self.S) if np.ndim(self.S) == 2 else (0, 0)
        S = judge.array("S", self.S, (n_q, n_z), ": a row for each joint, a column for each synergy")
        names = judge.named("synergies", self.synergies, n_z, "column of S")
        offset = judge.array("offset", np.zeros(n_q) if self.offset is None else self.offset, (n_q,))
        limits = np.full(n_z, np.inf) if self.effort_limits is None else self.effort_limits
        limits = judge.array("effort_limits", limits, (n_z,), infinite=True)
        if not judge.issues and np.any(limits <= 0):
            judge.refuse("effort_limits", f"must be greater than 0, got {limits.min():g}")
        judge.finish()
        for name, value in (("synergies", names), ("S", S), ("offset", offset), ("effort_limits", limits)):
            object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        """Return name, synergies and size, in one line."""
        names = ", ".join(self.synergies[:8]) + (", ..." if len(self.synergies) > 8 else "")
        return f"<SynergySet {self.name!r}: {names}; S {self.S.shape[0]} x {self.S.shape[1]}>"


@dataclass(frozen=True, eq=False)
class Coupling(ByContent):
    """A joint moved by other joints: q_follower = sum of ratio q_driver, + offset."""

    ratios: Mapping[str, float]
    """Driver -> ratio."""
    offset: float = 0.0  # [rad] or [m]
    rigid: bool = field(default=False, compare=False)
    """Whether nothing lets the joints part, as a clutch or a tendon does when a link is held by the object."""
    place: str = field(default="", compare=False)
    """Where that stands, for messages: file and line, or the key of the problem."""


@naming_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Hand(ByContent):
    """A robot hand as data; `load_hand` makes one.

    Example:
        >>> hand = load_hand("barrett")
        >>> len(hand.joints), hand.synergy_sets["motors"].synergies
        (8, ('spread', 'finger1', 'finger2', 'finger3'))
    """

    name: str
    title: str = ""
    joints: tuple[Joint, ...]
    C_q: Array = 0.0  # type: ignore[assignment]  # (n_q, n_q) [rad/(N m)]
    """A number or one for each joint stand for a diagonal."""
    pads: Mapping[str, Pad] = field(default_factory=dict)
    synergy_sets: Mapping[str, SynergySet]
    """The first one is the default; every hand also has "joints" (S = I)."""
    postures: Mapping[str, Array] = field(default_factory=dict)
    """Named joint values (n_q,)."""
    kinematics: Kinematics = field(compare=False)
    couplings: Mapping[str, Coupling] = field(default_factory=dict)
    """Follower -> its drivers; already in every synergy set but "joints"."""
    parents: Mapping[str, str] = field(default_factory=dict)
    """Link -> the link that carries it; parents before their children, the palm left out."""
    drives: Drives | None = None
    """None when no file says what drives what."""
    still: tuple[str, ...] = ()
    """Links and joints of its file that stand still, because the palm is a link that they carry, or hang beside it."""
    file: str = ""
    """Its model file; empty when it comes from no file."""

    def __post_init__(self) -> None:
        """Judge the values.

        Raises:
            InputError: joints, pads or synergy sets that are none, names that stand twice, shapes that do not fit.
        """
        judge = Arguments("Hand")
        judge.text("name", self.name)
        joints = judge.several("joints", self.joints, Joint, 'Joint(name="j1", kind="hinge")')
        judge.names("joints", [joint.name for joint in joints])
        C_q = judge.numbers("C_q", self.C_q, "a number, one for each joint, or a matrix")
        if not self.synergy_sets:
            judge.refuse("synergy_sets", "expected at least one; joint_set(names) has every joint by itself")
        judge.finish()
        n_q = len(joints)
        if C_q is not None and C_q.ndim < 2:
            C_q = np.diag(np.broadcast_to(C_q, (n_q,))) if C_q.shape in ((), (n_q,)) else C_q
        C_q = judge.array("C_q", C_q, (n_q, n_q))
        for name, chosen in self.synergy_sets.items():
            known = judge.one(f"synergy_sets[{name!r}]", chosen, SynergySet, "SynergySet(...)")
            if known is not None and len(known.S) != n_q:
                judge.refuse(f"synergy_sets[{name!r}]", f"S has {len(known.S)} rows for {n_q} joints")
        for name, pad in self.pads.items():
            judge.one(f"pads[{name!r}]", pad, Pad, "Pad(...)")
        postures = {name: judge.array(f"postures[{name!r}]", q, (n_q,)) for name, q in self.postures.items()}
        judge.finish()
        named = {"pads": self.pads, "synergy_sets": self.synergy_sets, "postures": postures}
        tables = {each: ByName(f"Hand.{each}", values) for each, values in named.items()}
        for each, value in {"joints": joints, "C_q": C_q, **tables}.items():
            object.__setattr__(self, each, value)

    def __eq__(self, other: object) -> bool:
        """Compare by content, and by where all links are and move at zero, which tells all that kinematics can."""
        if self is other or not isinstance(other, Hand):
            return self is other
        return super().__eq__(other) and same(self._home(), other._home())

    __hash__ = ByContent.__hash__

    def _home(self) -> tuple[PointMotion, ...]:
        origin = np.zeros(3)
        return self.kinematics.at(np.zeros(len(self.joints)), [(link, origin) for link in self.links])

    def __repr__(self) -> str:
        """Return name, joints, synergy sets and pads, in one line."""
        sets = ", ".join(f"{name} ({len(chosen.synergies)})" for name, chosen in self.synergy_sets.items())
        pads, postures = (", ".join(named) or "none" for named in (self.pads, self.postures))
        shown = f"{len(self.joints)} joints; synergies {sets}; postures {postures}; pads {pads}"
        return f"<Hand {self.name!r}: {shown if len(shown) < 600 else shown[:597] + '...'}>"

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints in the order of q."""
        return tuple(joint.name for joint in self.joints)

    @property
    def links(self) -> tuple[str, ...]:
        """Names of the links, the palm first and parents before their children."""
        palm = [link for link in self.parents.values() if link not in self.parents][:1]
        return (*palm, *self.parents)

    def carriers(self, link: str) -> Iterator[str]:
        """Yield a link and those that carry it, up to the palm."""
        yield link
        while link in self.parents:
            link = self.parents[link]
            yield link

    def pad(self, name: str, key: str = "") -> Pad:
        """Return a pad by name or raise an `InputError` that lists the pads."""
        if name not in self.pads:
            raise InputError.at(key, one_of(name, self.pads))
        return self.pads[name]
