"""SynGrasp's paradigmatic human hand from its published tables, independent of the library: numpy only."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from denavit_hartenberg import frames

DIGITS = ("thumb", "index", "middle", "ring", "little")
FINGER = ("mcp_abd", "mcp_flex", "pip", "dip")
JOINTS = (
    *(f"thumb_{joint}" for joint in ("tmc_abd", "tmc_flex", "mcp", "ip")),
    *(f"{digit}_{joint}" for digit in DIGITS[1:] for joint in FINGER),
)

# Syngrasp2.2/modeling/samplehands/SGparadigmatic.m: where each chain begins, length of each row, twist of each row
PLACES = {"thumb": (-37, 45), "index": (-24, 73), "middle": (-8, 73), "ring": (8, 73), "little": (24, 73)}  # mm
LENGTHS = {"thumb": (0, 25, 15, 10), "index": (0, 37, 30, 15), "middle": (0, 40, 35, 17), "ring": (0, 37, 30, 15),
           "little": (0, 27, 25, 10)}  # fmt: skip
TWISTS = {digit: (-np.pi / 2, 0, np.pi / 2 if digit == "thumb" else 0, 0) for digit in DIGITS}

# the side of the last frame that is said to touch: the pads' normals (models/hands/human/README.md)
PALMAR = {"thumb": 2, "index": 1, "middle": 1, "ring": 1, "little": 1}
RADIUS = 7.5e-3

Frames = list[npt.NDArray[np.float64]]


def hand_frames(q: npt.ArrayLike) -> dict[str, Frames]:
    """Return for each digit the frame that its chain begins in and the frame after each of its rows, for q (20,)."""
    angles = np.asarray(q, dtype=float).reshape(5, 4)
    return {digit: _digit_frames(digit, row) for digit, row in zip(DIGITS, angles, strict=True)}


def _digit_frames(digit: str, q: npt.NDArray[np.float64]) -> Frames:
    x, y = PLACES[digit]
    base = np.array([[0, -1, 0, x * 1e-3], [1, 0, 0, y * 1e-3], [0, 0, 1, 0], [0, 0, 0, 1]])
    rows = [(0.0, 0.0, a * 1e-3, alpha) for a, alpha in zip(LENGTHS[digit], TWISTS[digit], strict=True)]
    return [base, *frames(base, rows, q)]
