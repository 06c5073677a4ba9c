"""What the synergies of a grasp control, as a part of a JSON document; SI units, axes of the palm, about B."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from synergrip.linalg import RANK_TOLERANCE
from synergrip.reports.pictures.effects import Effect, effects
from synergrip.reports.pictures.steps import PLAIN, unit_of
from synergrip.statics.analysis import Analysis
from synergrip.statics.twists import describe_twist

KEY = "control"


def control_document(analysis: Analysis) -> dict[str, Any]:
    """Return the rigid motions that synergies can make, what moves no contact, and what each synergy does by itself."""
    grasp, spaces = analysis.grasp, analysis.spaces
    held, scale = grasp.held, analysis.response.scale
    units = [PLAIN if held is None else unit_of(held.hand, column) for column in grasp.S.T]
    motions = analysis.response.du_dzr.T * np.array([[unit.size] for unit in units])
    sizes = np.linalg.norm(scale.twist(motions), axis=1, keepdims=True)
    motions = np.where(sizes > RANK_TOLERANCE * sizes.max(initial=0.0), motions, 0.0)  # rounding is no motion
    return {
        "motions": [
            {"twist": twist.tolist(), "references": references.tolist(),
             "text": describe_twist(twist, grasp.contacts, scale.length)}
            for twist, references in zip(spaces.Gamma_ucs.T, spaces.Gamma_zcs.T, strict=True)
        ],
        "redundant": spaces.Gamma_zr.T.tolist(),
        "each": [_each(effect, own) for effect, own in zip(effects(analysis, units), motions, strict=True)],
    }  # fmt: skip


def _each(effect: Effect, motion: np.ndarray) -> dict[str, Any]:
    """Return what a small step of one synergy does: the motion of the object, and the size of the force it adds."""
    return {
        "name": effect.name, "step": effect.unit.size, "unit": effect.unit.name, "motion": motion.tolist(),
        "internal_N": np.linalg.norm(effect.forces.forces, axis=1).tolist(),
        "squeezing_share": None if math.isnan(effect.share) else effect.share,
    }  # fmt: skip
