"""From recorded postures to synergies: the principal directions, named and ready to be written."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from synergrip.hands.hand import Hand
from synergrip.hands.synergies.principal import Principal, principal_directions
from synergrip.hands.synergies.recorded import Recorded, read_postures
from synergrip.hands.synergies.synergy_file import SynergyFile

PREFIX = "pc"
"""Principal synergies are called pc1, pc2, ..."""


@dataclass(frozen=True, eq=False)
class Fit:
    """Synergies fitted to recorded postures."""

    recorded: Recorded
    principal: Principal
    file: SynergyFile


def fit(
    path: Path, count: int, hand: Hand | None = None, *, title: str = "", degrees: bool = False, key: str = "count"
) -> Fit:
    """Return the first principal synergies of recorded postures: q = S z + offset, offset the mean posture.

    Args:
        path: a CSV file, see `read_postures`.
        count: K, the number of synergies.
        hand: whose joints they are; without it the header names them.
        title: of the set; says where it comes from when empty.
        degrees: whether angles are degrees where the header does not say.
        key: what names K, for the error.

    Raises:
        InputError: a file that cannot be used, or K above the rank of its postures.
    """
    recorded = read_postures(path, hand, degrees=degrees)
    found = principal_directions(recorded.postures, count, key)
    values = {
        "schema": 1,
        "title": title or f"first {count} principal directions of {len(recorded.postures)} postures ({path.name})",
        "joints": recorded.joints,
        "synergies": tuple(f"{PREFIX}{i + 1}" for i in range(count)),
        "S": tuple(tuple(row) for row in found.directions.tolist()),
        "offset": tuple(found.mean.tolist()),
        "explained_variance": tuple(found.shares[:count].tolist()),
        "standard_deviation": tuple(found.deviations.tolist()),
    }
    return Fit(recorded, found, SynergyFile.model_validate(values))
