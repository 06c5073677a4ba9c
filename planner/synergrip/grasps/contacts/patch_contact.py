"""Patch contact: a flat round patch that transmits all six components, until it slips or tips."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.grasps.contacts.kind import FRICTION, SPIN_FRICTION, ByFormula, Parameter, diagonal
from synergrip.linalg import Array


@naming_arguments
@dataclass(frozen=True, kw_only=True)
class PatchContact(ByFormula):
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

    @classmethod
    def cones_with(cls, values: Mapping[str, Array]) -> tuple[Array, ...]:
        """(4, 6): rows mu n, t, o, mu m / nu; and (3, 6): rows n, m_t / r, m_o / r."""
        mu, reach = values["friction"], 1 / values["patch_radius"]
        every = diagonal(mu, 1.0, 1.0, mu / values["spin_friction"], reach, reach)
        slip, tipping = every[..., :4, :], every[..., 3:, :]
        tipping = np.array(tipping)
        tipping[..., 0, :] = np.eye(6)[0]
        return slip, tipping
