"""Patch contact: a flat round patch that transmits all six components, until it slips or tips."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.grasps.contacts.kind import FRICTION, SPIN_FRICTION, ContactKind, Parameter
from synergrip.linalg import Array, frozen


@naming_arguments
@dataclass(frozen=True, kw_only=True)
class PatchContact(ContactKind):
    """A flat round patch of radius r: six components, and two cones.

    It slips like a soft finger, ``sqrt((t^2 + o^2) / mu^2 + (m / nu)^2) <= n``, and it tips when the centre of
    pressure, ``(-m_o, m_t) / n`` from the middle along t and o, leaves the patch: ``||(m_t, m_o)|| <= r n``. Its slip
    margin is the smaller of ``mu n - sqrt(t^2 + o^2 + (mu m / nu)^2)`` and ``n - ||(m_t, m_o)|| / r``, both in newtons.

    Args:
        friction: Coulomb coefficient mu.
        spin_friction: nu, moment about the normal carried for each newton of normal force [m]; 2/3 mu r under a
            pressure that is the same everywhere.
        patch_radius: r, the largest distance of the centre of pressure from the middle [m].

    Raises:
        InputError: a parameter that is no finite number greater than 0.

    Example:
        >>> PatchContact(friction=0.6, spin_friction=0.003, patch_radius=0.008).components
        ('n', 't', 'o', 'm', 'm_t', 'm_o')
    """

    friction: float
    spin_friction: float  # [m]
    patch_radius: float  # [m]

    name: ClassVar[str] = "patch"
    title: ClassVar[str] = "patch"
    components: ClassVar[tuple[str, ...]] = ("n", "t", "o", "m", "m_t", "m_o")
    parameters: ClassVar[tuple[Parameter, ...]] = (
        FRICTION, SPIN_FRICTION,
        Parameter("patch_radius", "largest distance of the centre of pressure from the middle", '"8 mm"', length=True),
    )  # fmt: skip
    sides: ClassVar[tuple[str, ...]] = ("slip", "tipping")

    @property
    def cones(self) -> tuple[Array, ...]:
        """(4, 6): rows mu n, t, o, mu m / nu; and (3, 6): rows n, m_t / r, m_o / r."""
        slip, tipping = np.eye(4, 6), np.zeros((3, 6))
        slip[0, 0], slip[3, 3] = self.friction, self.friction / self.spin_friction
        tipping[0, 0], tipping[1, 4], tipping[2, 5] = 1.0, 1 / self.patch_radius, 1 / self.patch_radius
        return frozen(slip), frozen(tipping)
