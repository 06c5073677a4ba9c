"""What the robot is: joints, compliance, synergies, pads. The paper's left-hand side of (9) and (10)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from synergrip.errors import InputError, one_of
from synergrip.linalg import Array


@dataclass(frozen=True)
class PointMotion:
    """Where a point of a link is, and how it moves with the joints, in the palm frame."""

    position: Array
    """(3,) position of the point [m]."""
    rotation: Array
    """(3, 3) orientation of its link: link coordinates to palm coordinates."""
    jacobian: Array
    """(6, n_q) rows v (point velocity), omega, for unit joint rates [m or 1, rad or rad/m]."""


class Kinematics(Protocol):
    """The one thing asked of a kinematics library."""

    def at(self, q: Array, points: Sequence[tuple[str, Array]]) -> tuple[PointMotion, ...]:
        """Return the motion of each (link name, point in link coordinates [m]) at joint values `q` (n_q,)."""


@dataclass(frozen=True)
class Joint:
    """One joint, in the order of q."""

    name: str
    kind: str
    """"hinge" (rad, N m) or "slide" (m, N)."""
    lower: float  # [rad] or [m]
    upper: float  # [rad] or [m]
    torque_limit: float
    """|tau| allowed [N m] or [N]; infinity when the hand states none."""
    link: str = ""
    """The link that it turns or shifts."""
    place: str = field(default="", compare=False)
    """File and line that state the range, for messages."""


@dataclass(frozen=True)
class Pad:
    """A place on a link that is made to touch things."""

    name: str
    link: str
    point: Array
    """(3,) in link coordinates [m]."""
    normal: Array
    """(3,) unit outward normal in link coordinates: the direction in which the pad pushes."""
    radius: float = 0.0
    """[m] of a round pad with its centre at `point`, which touches where the object is nearest; 0 for the point."""


@dataclass(frozen=True)
class SynergySet:
    """A named synergy matrix S (9)."""

    name: str
    title: str
    synergies: tuple[str, ...]
    """Name of each column."""
    S: Array  # (n_q, n_z)
    offset: Array
    """(n_q,) joint values at z = 0: q = S z + offset."""
    effort_limits: Array
    """(n_z,) |sigma| allowed; infinity where the hand states none."""


@dataclass(frozen=True)
class Coupling:
    """A joint moved by other joints: q_follower = sum of ratio q_driver, + offset."""

    ratios: Mapping[str, float]
    """Driver -> ratio."""
    offset: float = 0.0  # [rad] or [m]
    rigid: bool = field(default=False, compare=False)
    """Whether nothing lets the joints part, as a clutch or a tendon does when a link is held by the object."""
    place: str = field(default="", compare=False)
    """Where that stands, for messages: file and line, or the key of the problem."""


@dataclass(frozen=True, eq=False)
class Drives:
    """What a model file says of motors and springs, for the joints that no motor moves."""

    compliance: Array
    """(n_q, n_q) yield of the joints to torques, by springs that no motor holds [rad/(N m)]."""
    sprung: Mapping[str, float] = field(default_factory=dict)
    """Joint that springs alone hold -> where they hold it [rad or m]."""
    loose: Mapping[str, str] = field(default_factory=dict)
    """Joint of which the file does not say how it moves, and how far it yields -> why not, as a clause."""
    notes: tuple[str, ...] = ()
    """What was taken for something else, or not read, though it is no error."""
    pulls: Array | None = None
    """(n_a, n_q) joint torque per force of each actuator; None when nothing says what an effort is."""
    forces: Array | None = None
    """(n_a,) largest force of each actuator; infinity when none is stated."""

    @property
    def idle(self) -> tuple[str, ...]:
        """Joints that are no synergies, because no motor of the file is known to move them."""
        return (*self.sprung, *self.loose)


@dataclass(frozen=True)
class Hand:
    """A robot hand as data."""

    name: str
    title: str
    joints: tuple[Joint, ...]
    C_q: Array  # (n_q, n_q) [rad/(N m)]
    pads: Mapping[str, Pad]
    synergy_sets: Mapping[str, SynergySet]
    """The first one is the default; every hand also has "joints" (S = I)."""
    postures: Mapping[str, Array]
    """Named joint values (n_q,)."""
    kinematics: Kinematics
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
