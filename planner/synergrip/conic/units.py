"""Units of the program's unknowns."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Units:
    """Sizes of forces, references and motions."""

    force: float  # [N]
    reference: float
    motion: float = 1.0  # [m]
