"""What the school says of a grasp before any task: its classes, squeezes, stiffness, manipulability, singularities."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from synergrip.documents.judging import described
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.effects import ReferenceEffect, reference_effects
from synergrip.statics.ellipsoids import Ellipsoid, ellipsoids, object_stiffness
from synergrip.statics.null_spaces import NullSpace, null_spaces
from synergrip.statics.restraint import NO_LOAD
from synergrip.statics.singularity import SingularityDistance, singularity_distances
from synergrip.values import Value


@made_by("grasp_properties(grasp)")
@dataclass(frozen=True, eq=False, repr=False)
class GraspProperties(Value):
    """What is true of a grasp before any task, by the names of the textbooks; SI units.

    Example:
        >>> properties = grasp_properties(grasp)
        >>> [name for name, each in properties.of_synergies.items() if each.holds]
        ['graspable', 'defective']
        >>> properties.ellipsoids["stiffness"].unit, properties.stiffness.shape
        ('N/m', (6, 6))
    """

    analysis: Analysis
    of_joints: Mapping[str, NullSpace]
    """"redundant", "indeterminate", "graspable", "defective", "hyperstatic", every joint being driven by itself."""
    of_synergies: Mapping[str, NullSpace]
    """The same as the synergies drive it, with ``J S`` in place of J."""
    effects: Mapping[str, ReferenceEffect]
    """"pure squeeze", "spurious squeeze", "motion without force", "redundant motion": the references, n_z in all."""
    stiffness: Array
    """(6, 6) wrench on the object for each displacement about B, references fixed: ``G K G'`` [N/m, N, N m/rad]."""
    compliance: Array | None
    """(6, 6) its inverse [m/N, 1/N, rad/(N m)]; None where the object is free to move."""
    ellipsoids: Mapping[str, Ellipsoid]
    """Of stiffness and compliance, and of motion and force by references."""
    singularity: Mapping[str, SingularityDistance]
    """How far G, J S and the parts of J S are from a lower rank."""

    @property
    def ambiguous(self) -> bool:
        """Whether a singular value that decides on a dimension lies in the grey zone."""
        spaces = (*self.of_joints.values(), *self.of_synergies.values())
        decisions = (*(each.decision for each in spaces), *(each.decision for each in self.effects.values()))
        return any(decision.ambiguous for decision in decisions)

    def __repr__(self) -> str:
        """Return the classes of the grasp."""
        names = ", ".join(name for name, each in self.of_synergies.items() if each.holds) or "of no class"
        return f"GraspProperties({names}{', ambiguous' * self.ambiguous})"


@naming_arguments
def grasp_properties(grasp: Grasp | Analysis) -> GraspProperties:
    """Return what the textbooks name of a grasp: classes, squeezes, stiffness, manipulability, distance to singularity.

    Every number has its formula, unit and source beside it. Classes are those of G and J, or J S, alone; the rest is
    that of the linear model at the start posture. An object that is free to move is no error here, whatever loads it.

    Args:
        grasp: the grasp, or its analysis.

    Returns:
        the properties; bases are orthonormal in the scaled coordinates of the grasp.

    Raises:
        InputError: something else.
        RigidContactError: some contact direction has no compliance at all, so that no stiffness is known.

    Example:
        >>> properties = grasp_properties(grasp)
        >>> {name: effect.dimension for name, effect in properties.effects.items()}
        {'pure squeeze': 0, 'spurious squeeze': 3, 'motion without force': 1, 'redundant motion': 0}
    """
    if not isinstance(grasp, Grasp | Analysis):
        raise InputError.at("grasp", f"expected a Grasp such as make_grasp(...), got {described(grasp)}")
    analysis = analyse(grasp, NO_LOAD) if isinstance(grasp, Grasp) else grasp
    response, scale = analysis.response, analysis.response.scale
    stiffness, compliance = object_stiffness(response)
    effects = reference_effects(analysis)
    still = effects["pure squeeze"].dimension + effects["redundant motion"].dimension
    return GraspProperties(
        analysis=analysis,
        of_joints=null_spaces(analysis.grasp, scale, synergies=False),
        of_synergies=null_spaces(analysis.grasp, scale, synergies=True),
        effects=effects,
        stiffness=stiffness,
        compliance=compliance,
        ellipsoids=ellipsoids(response, analysis.spaces.dimensions[0], analysis.grasp.n_z - still),
        singularity=singularity_distances(analysis.grasp, scale),
    )
