"""Forward kinematics from classical Denavit-Hartenberg tables, independent of the library: numpy only."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

Row = tuple[float, float, float, float]


def row(theta: float, d: float, a: float, alpha: float) -> npt.NDArray[np.float64]:
    """Return Rz(theta) Tz(d) Tx(a) Rx(alpha), (4, 4)."""
    ct, st, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array([[ct, -st * ca, st * sa, a * ct], [st, ct * ca, -ct * sa, a * st], [0, sa, ca, d], [0, 0, 0, 1]])


def frames(
    base: npt.ArrayLike, rows: Sequence[Row], q: Sequence[float] | npt.NDArray[np.float64]
) -> list[npt.NDArray[np.float64]]:
    """Return the frame after each row of a chain, in the frame that `base` is given in.

    Args:
        base: Frame before the first row, (4, 4); joint 1 turns about its z axis.
        rows: (theta_offset, d, a, alpha) of each joint, in radians and metres.
        q: Joint angles, added to the theta offsets.

    Returns:
        One (4, 4) frame for each row.
    """
    found = [np.array(base, dtype=float)]
    for (offset, d, a, alpha), angle in zip(rows, q, strict=True):
        found.append(found[-1] @ row(offset + angle, d, a, alpha))
    return found[1:]


def orthonormal(frame: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Return a (4, 4) frame whose rotation is the one nearest to a rotation printed with few digits (polar factor)."""
    near = np.array(frame, dtype=float)
    left, _, right = np.linalg.svd(near[:3, :3])
    if np.linalg.det(left @ right) < 0:
        raise ValueError("the printed matrix is left-handed")
    near[:3, :3] = left @ right
    return near
