"""What one synergy alone does at the contacts: the columns of (28), and how much of its motion ends up in them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.linalg import RANK_TOLERANCE, SINGULAR, Array, frozen
from synergrip.reports.pictures.forces import ContactForces, contact_forces
from synergrip.reports.pictures.steps import Unit
from synergrip.statics.analysis import Analysis
from synergrip.statics.response import Response


@dataclass(frozen=True)
class Effect:
    """What one synergy alone does at the contacts, for one unit of it."""

    name: str
    unit: Unit
    forces: ContactForces
    share: float
    """Of its contact motion that squeezes; NaN when it moves no contact."""

    @property
    def titles(self) -> tuple[str, str]:
        """Two lines: the size of the largest force, and how much of the contact motion squeezes."""
        if math.isnan(self.share):
            return "no internal force", "it moves no contact"
        if self.share == 0:
            return "no internal force", "the object follows it rigidly"
        spin = f", {_digits(self.forces.largest_spin)} N m" if self.forces.largest_spin > 0 else ""
        first = f"up to {_digits(self.forces.largest)} N{spin} {self.unit.each}"
        return first, f"{_digits(100 * self.share)}% of its contact motion squeezes"


def effects(analysis: Analysis, units: Sequence[Unit]) -> tuple[Effect, ...]:
    """Return what each of the first synergies does at the contacts, one for each unit: ``d lambda`` of (28), dw = 0."""
    grasp, scale, shares = analysis.grasp, analysis.response.scale, squeeze_shares(analysis.response)
    found = []
    for k, unit in enumerate(units):
        column = analysis.response.dlambda_dzr[:, k] * unit.size
        floor = RANK_TOLERANCE * scale.largest_force(column) if shares[k] > 0 else math.inf
        column = np.where(np.abs(column * scale.force) > floor, column, 0.0)  # rounding is no force
        found.append(Effect(grasp.synergies[k], unit, contact_forces(grasp.contacts, column), float(shares[k])))
    return tuple(found)


def squeeze_shares(response: Response) -> Array:
    """Return the share (n_z,) of the contact motion of each synergy, J S e_k, that no rigid object motion follows.

    What is left over squeezes: a synergy generates internal forces exactly when its share is not 0, whatever the
    compliances. A share below the rank tolerance is 0; that of a synergy that moves no contact is NaN.
    """
    scale, grasp = response.scale, response.grasp
    Gt = grasp.G.T @ np.linalg.inv(scale.motion) / scale.force[:, None]
    J = grasp.J / scale.force[:, None]
    JS, held = J @ grasp.S, np.linalg.qr(Gt)[0]
    against = np.linalg.norm(JS - held @ (held.T @ JS), axis=0)
    moved = np.linalg.norm(JS, axis=0)
    rounding = SINGULAR * np.linalg.norm(J, 2) * np.linalg.norm(grasp.S, 2)
    floor = max(RANK_TOLERANCE * float(np.linalg.norm(JS, 2)), float(rounding))
    shares = np.where(against > floor, against / np.where(moved > 0, moved, 1.0), 0.0)
    return frozen(np.where(moved > floor, shares, np.nan))


def _digits(value: float) -> str:
    """Return a number with two digits, and no power of ten unless it is very small or large."""
    return f"{float(f'{value:.2g}'):g}"
