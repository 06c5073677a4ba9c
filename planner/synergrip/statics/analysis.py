"""The statics of one grasp, worked out once: response, subspaces, Theorem 1."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from synergrip.documents.naming import made_by, naming_arguments
from synergrip.grasps.facing import frame_notes
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.statics import Coordinates, Response, Subspaces, coordinates, respond, subspaces
from synergrip.values import Value


@made_by("analyse(grasp)")
@dataclass(frozen=True, eq=False, repr=False)
class Analysis(Value):
    """Everything that is true of a grasp before any task.

    Example:
        >>> analysis = analyse(grasp)
        >>> analysis.response.dlambda_dzr.shape, analysis.spaces.E_s.shape
        ((9, 4), (9, 3))
    """

    grasp: Grasp
    response: Response
    spaces: Subspaces
    coordinates: Coordinates

    @cached_property
    def frame_notes(self) -> tuple[str, ...]:
        """What is odd about the contact frames that a user states."""
        return tuple(frame_notes(self.grasp))

    def begun(self, grasp: Grasp) -> Analysis:
        """Return it for the grasp as it is when a task begins: of w_0 nothing depends but what is remembered of it."""
        return replace(self, grasp=grasp, response=replace(self.response, grasp=grasp))

    def __repr__(self) -> str:
        """Return counts and dimensions."""
        grasp, (forces, motions, redundant) = self.grasp, self.spaces.dimensions
        return (
            f"Analysis({grasp.n_c} contacts, {grasp.n_q} joints, {grasp.n_z} synergies: "
            f"dim E_s {forces}, Gamma_ucs {motions}, Gamma_zr {redundant}{', ambiguous' * self.spaces.ambiguous})"
        )


@naming_arguments
def analyse(grasp: Grasp, load: Array | None = None) -> Analysis:
    """Return the analysis of a grasp.

    Args:
        grasp: the grasp.
        load: (T, 6) wrenches it is to hold, for a refusal to tell about (default: w_0).

    Raises:
        InputError: no grasp, or no wrenches.
        NotRestrainedError: the contacts leave the object a free motion.
        RigidContactError: some contact direction has no compliance at all.

    Example:
        >>> analyse(grasp).spaces.dimensions
        (3, 1, 0)
    """
    response = respond(grasp, load)
    spaces = subspaces(response)
    return Analysis(grasp, response, spaces, coordinates(response, spaces))
