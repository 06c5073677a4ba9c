"""The matrices of a grasp judged as those of a grasp file, for grasps that are made in Python."""

from __future__ import annotations

import numpy as np

from synergrip.documents.judging import Arguments
from synergrip.grasps.matrix_reading import SYMMETRY, is_semidefinite
from synergrip.linalg import Array, frozen


class Judge(Arguments):
    """Judges compliances, too."""

    def compliance(self, name: str, value: object, size: int, largest: float = np.inf) -> Array:
        """Return a symmetric positive semidefinite matrix; a number c stands for c times the identity.

        Args:
            name: of the argument.
            value: what came.
            size: rows and columns.
            largest: that an entry of the diagonal may be.
        """
        found = self.numbers(name, value, f"a number or a matrix of shape {(size, size)}")
        if found is not None and found.ndim == 0:
            if found < 0:
                self.refuse(name, f"a compliance must not be negative, got {float(found):g}")
            return self._kept(name, frozen(np.eye(size) * float(found)), largest)
        if found is not None and found.shape != (size, size):
            hint = "; np.diag makes a matrix of its diagonal" if found.shape == (size,) else ""
            self.refuse(name, f"expected a number, or shape {(size, size)}, got {found.shape}{hint}")
        elif found is not None and size and not self._is_semidefinite(name, found):
            found = None
        return (
            frozen(np.zeros((size, size)))
            if found is None or found.shape != (size, size)
            else self._kept(name, found, largest)
        )

    def _kept(self, name: str, matrix: Array, largest: float) -> Array:
        """Return the matrix symmetric to the last digit, after noting that it is beyond all compliances."""
        if (most := float(np.diag(matrix).max(initial=0.0))) > largest:
            self.refuse(name, f"a compliance of {most:g} is too large")
        return matrix if np.array_equal(matrix, matrix.T) else frozen((matrix + matrix.T) / 2)

    def _is_semidefinite(self, name: str, matrix: Array) -> bool:
        largest, diagonal = float(np.abs(matrix).max()), np.diag(matrix)
        if np.abs(matrix - matrix.T).max() > SYMMETRY * largest:
            self.refuse(name, "is not symmetric")
        elif np.any(diagonal < 0) or not is_semidefinite(matrix):
            smallest = float(np.linalg.eigvalsh(matrix)[0])
            self.refuse(name, f"is not positive semidefinite: its smallest eigenvalue is {smallest:.6g}")
        else:
            return True
        return False


def columns(matrix: object) -> int:
    """Return the number of columns of what may be a matrix; 0 for what is none."""
    try:
        shape = np.asarray(matrix, dtype=np.float64).shape
    except (TypeError, ValueError, OverflowError):
        return 0
    return shape[1] if len(shape) == 2 else 0
