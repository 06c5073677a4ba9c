"""The matrices of a grasp judged as those of a grasp file, for grasps that are made in Python."""

from __future__ import annotations

import numpy as np

from synergrip.documents.judging import Arguments
from synergrip.grasps.matrix_reading import SYMMETRY, is_semidefinite
from synergrip.linalg import Array, frozen

OF_CONTACTS = "for each force component of the contacts"


class Judge(Arguments):
    """Judges kinematics and compliances, too."""

    def kinematics(self, G: object, J: object, S: object, n_l: int) -> tuple[Array, Array, Array]:
        """Return G (6, n_l), J (n_l, n_q) and S (n_q, n_z).

        S is judged against a J that is right: a wrong one would make two mistakes of one.
        """
        kept = self.array("G", G, (6, n_l), f": a column {OF_CONTACTS}")
        jacobian = self._matrix("J", J, n_l, f"a row {OF_CONTACTS} and a column for each joint")
        n_q = None if jacobian is None else jacobian.shape[1]
        columns = "a row for each joint, as J has columns, and a column for each synergy"
        synergies = self._matrix("S", S, n_q, columns)
        none = frozen(np.zeros((0, 0)))
        return kept, none if jacobian is None else jacobian, none if synergies is None else synergies

    def _matrix(self, name: str, value: object, rows: int | None, what: str) -> Array | None:
        """Return a matrix of so many rows, or of any number of them; None after noting why not."""
        wanted = f"({rows or 'n_q'}, {'n_q' if name == 'J' else 'n_z'})"
        found = self.numbers(name, value, f"a matrix of shape {wanted}")
        if found is None:
            return None
        hint = ""
        if found.ndim == 1:
            hint = "; np.reshape(..., (-1, 1)) makes one column of it" if rows in (None, found.size) else ""
        elif found.ndim == 2 and rows == found.shape[1] != found.shape[0]:
            hint = "; it fits when transposed"
        if found.ndim != 2 or rows not in (None, found.shape[0]):
            self.refuse(name, f"expected shape {wanted}: {what}; got {found.shape}{hint}")
            return None
        return found

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
