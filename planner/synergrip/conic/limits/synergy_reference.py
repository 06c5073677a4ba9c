"""|dz_r| within the limit of every synergy."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.file_key import FileKey, References
from synergrip.conic.limits.symmetric import Symmetric
from synergrip.documents.naming import naming_arguments
from synergrip.linalg import Array
from synergrip.statics.motion import Motion


@naming_arguments
@dataclass(frozen=True, eq=False)
class SynergyReference(Symmetric):
    """``|dz_r| <= limit`` for each synergy.

    Args:
        limit: largest change [synergy units] for all synergies, or one for each; infinity for none.

    Raises:
        InputError: no numbers greater than 0.

    Example:
        ``SynergyReference(0.5)``
    """

    key = "limits.synergy_reference"
    title = "synergy reference"
    cause = "synergy_range"
    of_references_alone = True

    def value(self, formulation: Formulation) -> Affine:
        """Return the references."""
        return formulation.reference

    def reached(self, motion: Motion) -> Array:
        """Return the references (T, n_z)."""
        return motion.dz_r


IN_FILE = FileKey(
    "synergy_reference", SynergyReference, References, "largest change of a synergy reference, one or one per synergy",
)  # fmt: skip
