"""The arrays in which grasps of one form may differ, judged as those of one grasp are."""

from __future__ import annotations

import numpy as np

from synergrip.documents.judging import as_numbers, described
from synergrip.documents.validation import LARGEST_NUMBER
from synergrip.errors import InputError
from synergrip.grasps.matrix_reading import SEMIDEFINITE, SYMMETRY
from synergrip.linalg import Array, frozen

VARIED = ("points", "G", "J", "S", "C_s", "C_q", "C_z", "w_0")
"""What may differ from grasp to grasp."""


def judged_array(name: str, value: object, own: dict[str, Array]) -> Array:
    """Return the array of a name for N grasps, where `own` has those of one grasp (1, ...).

    Raises:
        InputError: no such array, or one whose shape or values do not fit.
    """
    if name not in VARIED:
        raise InputError.at(name, f"is no array of a grasp; expected one of {', '.join(VARIED)}")
    wanted = own[name].shape[1:]
    found = as_numbers(value)
    if found is None:
        raise InputError.at(name, f"expected numbers of shape {('N', *wanted)}, got {described(value)}")
    found = frozen(found)
    if found.ndim != len(wanted) + 1 or found.shape[1:] != wanted or not len(found):
        shape = ", ".join(map(str, ("N", *wanted)))
        raise InputError.at(name, f"expected shape ({shape}), a matrix for each of N grasps, got {found.shape}")
    if not np.all(np.isfinite(found)):
        raise InputError.at(name, f"expected finite numbers, got {float(found[~np.isfinite(found)][0])}")
    if np.abs(found).max() > LARGEST_NUMBER:
        raise InputError.at(name, f"{np.abs(found).max():g} is too large")
    if name.startswith("C_"):
        _judge_compliances(name, found)
    return found


def _judge_compliances(name: str, found: Array) -> None:
    """Refuse what `Grasp` refuses: matrices that are not symmetric, or not positive semidefinite."""
    largest = np.abs(found).max(axis=(-2, -1), initial=0.0)
    askew = np.abs(found - found.mT).max(axis=(-2, -1), initial=0.0) > SYMMETRY * largest
    diagonal = np.diagonal(found, axis1=-2, axis2=-1)
    root = np.sqrt(np.where(diagonal > 0, diagonal, np.where(largest > 0, largest, 1.0)[:, None]))
    least = np.linalg.eigvalsh(found / (root[:, :, None] * root[:, None, :])).min(axis=-1, initial=0.0)
    for what, wrong in (("symmetric", askew), ("positive semidefinite", least < -SEMIDEFINITE)):
        if np.any(wrong):
            raise InputError.at(f"{name}[{int(np.argmax(wrong))}]", f"is not {what}, as a compliance must be")
