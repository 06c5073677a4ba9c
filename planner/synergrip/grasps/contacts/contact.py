"""A contact: where it is, and of which kind."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from synergrip.documents.judging import Arguments
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.linalg import Array, frozen
from synergrip.values import ByContent
from synergrip.vectors import crossed

ORTHONORMAL = 1e-4
"""How far the products of the columns of a frame may be from those of unit vectors normal to each other."""


@naming_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Contact(ByContent):
    """One contact of a grasp. The normal points toward the object: lambda_n >= 0 is pushing.

    Example:
        >>> from synergrip.grasps.contacts.hard_finger import HardFinger
        >>> thumb = Contact(name="thumb", kind=HardFinger(friction=0.6), point=(0.02, 0, 0), frame=np.eye(3))
        >>> float(thumb.slip_margin(np.array([1.0, 0.0, 0.5])))
        0.09999999999999998
    """

    name: str
    kind: ContactKind
    point: Array
    """(3,) position from the object frame B, axes of N [m]."""
    frame: Array
    """(3, 3) columns n, t, o, axes of N: right-handed unit vectors, n toward the object."""
    normal_at: str = field(default="", compare=False)
    """Where a user states the normal, for advice; empty when it follows from the object."""

    def __post_init__(self) -> None:
        """Judge the values.

        Raises:
            InputError: a name that is none, a kind that is none, a point or frame that is none.
        """
        judge = Arguments("Contact")
        judge.text("name", self.name, empty=False)
        judge.one("kind", self.kind, ContactKind, "HardFinger(friction=0.6)")
        point = judge.array("point", self.point, (3,))
        frame = judge.array("frame", self.frame, (3, 3), ", the columns n, t and o")
        if not judge.issues and not np.allclose(frame.T @ frame, np.eye(3), rtol=0, atol=ORTHONORMAL):
            judge.refuse("frame", "its columns n, t and o must be unit vectors normal to each other")
        judge.finish()
        object.__setattr__(self, "point", point)
        object.__setattr__(self, "frame", frame)

    def __repr__(self) -> str:
        """Return name, kind and place, in one line."""
        return f"<Contact {self.name!r}: {self.kind} at {self.point.round(6).tolist()} m>"

    @property
    def normal(self) -> Array:
        """(3,) unit vector toward the object, the first column of its frame: along it the hand pushes."""
        return frozen(self.frame[:, 0])

    @property
    def n_rows(self) -> int:
        """Number of force components."""
        return len(self.kind.components)

    @property
    def friction(self) -> float:
        """Coulomb coefficient, for reports: in the direction that has the least; 0 for a frictionless contact."""
        return self.kind.least_friction

    @property
    def cones(self) -> tuple[Array, ...]:
        """Cone matrices W (d, rows) of this contact."""
        return self.kind.cones

    def slip_margin(self, force: Array) -> Array:
        """Return the slip margin [N] of forces (..., rows): shape (...).

        ``(W lambda)_0 - ||(W lambda)_1..||``, the smallest of its cones: hard finger ``mu n - ||(t, o)||``, soft
        finger ``mu n - sqrt(t^2 + o^2 + (mu m / nu)^2)``; a frictionless contact cannot slip, its margin is the normal
        force itself. A contact that would have to pull is missed by that pull at least, however little friction it
        has.
        """
        force, rows = np.asarray(force), len(self.kind.components)
        if force.shape[-1:] != (rows,):
            wanted = f"forces (..., {rows}), one for each of {', '.join(self.kind.components)}"
            raise InputError.at("force", f"expected {wanted}, got shape {force.shape}")
        head, tail, _ = self.nearest_cone(force)
        margin, normal = head - tail, force[..., 0]
        return np.asarray(np.where(normal < 0, np.minimum(margin, normal), margin))

    def nearest_cone(self, force: Array) -> tuple[Array, Array, Array]:
        """Return of forces (..., rows) ``(W lambda)_0``, ``||(W lambda)_1..||`` [N] and the friction mu, (...) each.

        They are those of the cone whose slip margin is the smallest; without friction mu is 0, and so is the second.
        """
        if len(self.cones) == 1:
            image, mu = force @ self.cones[0].T, self.cones[0][0, 0] if len(self.cones[0]) > 1 else 0.0
            return image[..., 0], np.linalg.norm(image[..., 1:], axis=-1), np.full(force.shape[:-1], mu)
        images = [force @ W.T for W in self.cones]
        heads = np.stack([image[..., 0] for image in images])
        tails = np.stack([np.linalg.norm(image[..., 1:], axis=-1) for image in images])
        nearest = np.argmin(heads - tails, axis=0)
        friction = np.array([W[0, 0] if len(W) > 1 else 0.0 for W in self.cones])
        head, tail = (np.take_along_axis(each, nearest[None], axis=0)[0] for each in (heads, tails))
        return head, tail, friction[nearest]


def contact_frame(normal: Array, tangent: Array | None = None) -> Array:
    """Return (3, 3) columns n, t, o for a normal (3,).

    Args:
        normal: (3,) of any length.
        tangent: (3,) direction that t follows as far as it is normal to n; the axis farthest from n when absent.
    """
    return frozen(contact_frames(np.asarray(normal, dtype=float), tangent))


def contact_frames(normals: Array, tangents: Array | None = None) -> Array:
    """Return (..., 3, 3) the same for normals (..., 3), and tangents (..., 3)."""
    n = normals / np.linalg.norm(normals, axis=-1, keepdims=True)
    if tangents is None:
        sizes = np.abs(n)
        tangents = np.eye(3)[np.argmin(sizes > sizes.min(axis=-1, keepdims=True) + 1e-9, axis=-1)]
    t = tangents - (tangents * n).sum(axis=-1, keepdims=True) * n
    t = t / np.linalg.norm(t, axis=-1, keepdims=True)
    return np.stack([n, t, crossed(n, t)], axis=-1)
