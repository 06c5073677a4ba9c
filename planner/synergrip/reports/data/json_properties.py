"""The properties of a grasp by their textbook names, as a part of a JSON document."""

from __future__ import annotations

from typing import Any

from synergrip.linalg import Decision
from synergrip.planning.told import finite
from synergrip.statics.effects import ReferenceEffect
from synergrip.statics.ellipsoids import Ellipsoid
from synergrip.statics.grasp_properties import GraspProperties
from synergrip.statics.null_spaces import NullSpace
from synergrip.statics.singularity import SingularityDistance


def properties_document(found: GraspProperties) -> dict[str, Any]:
    """Return classes, references, stiffness, ellipsoids and distances; SI units, each with formula, unit and source."""
    return {
        "classes": {
            by: {name: _class(each) for name, each in spaces.items()}
            for by, spaces in (("joints", found.of_joints), ("synergies", found.of_synergies))
        },
        "references": {name: _effect(each) for name, each in found.effects.items()},
        "stiffness": found.stiffness.tolist(),
        "compliance": None if found.compliance is None else found.compliance.tolist(),
        "ellipsoids": {name: _ellipsoid(each) for name, each in found.ellipsoids.items()},
        "singularity": {name: _distance(each) for name, each in found.singularity.items()},
        "characteristic_length_m": found.analysis.response.scale.length,
        "ambiguous": found.ambiguous,
    }


def _class(space: NullSpace) -> dict[str, Any]:
    return {
        "holds": space.holds, "dimension": space.dimension, "basis": space.basis.tolist(), **_named(space),
        **_decision(space.decision),
    }  # fmt: skip


def _effect(effect: ReferenceEffect) -> dict[str, Any]:
    return {
        "dimension": effect.dimension, "references": effect.references.tolist(), "forces": effect.forces.tolist(),
        "motions": effect.motions.tolist(), **_named(effect), **_decision(effect.decision),
    }  # fmt: skip


def _named(of: NullSpace | ReferenceEffect | SingularityDistance) -> dict[str, str]:
    return {"formula": of.formula, "meaning": of.meaning, "unit": of.unit, "source": of.source}


def _decision(decision: Decision) -> dict[str, Any]:
    return {"singular_values": decision.singular_values.tolist(), "ambiguous": decision.ambiguous}


def _ellipsoid(of: Ellipsoid) -> dict[str, Any]:
    references = {} if of.references is None else {"references": of.references.tolist()}
    return {
        "values": [finite(value) for value in of.values], "axes": of.axes.tolist(), **references,
        "isotropy": of.isotropy, "formula": of.formula, "unit": of.unit, "source": of.source,
    }  # fmt: skip


def _distance(of: SingularityDistance) -> dict[str, Any]:
    return {
        "smallest": of.smallest, "relative": of.relative, "largest": of.largest, "rank": of.decision.rank,
        "full_rank": of.full, **_named(of), **_decision(of.decision),
    }  # fmt: skip
