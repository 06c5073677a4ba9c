"""The matrices of a grasp judged as those of a grasp file, for grasps that are made in Python."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from synergrip.documents.validation import shown
from synergrip.errors import Issue
from synergrip.grasps.matrix_reading import SEMIDEFINITE, SYMMETRY, least_scaled_eigenvalue
from synergrip.linalg import Array, frozen


@dataclass
class Judge:
    """Returns each value as it is to be kept, and collects what is wrong with them."""

    of: str
    """What the values belong to, in front of their names."""
    issues: list[Issue] = field(default_factory=list)

    def refuse(self, name: str, message: str) -> None:
        """Note that an argument is wrong."""
        self.issues.append(Issue(message, key=f"{self.of}.{name}"))

    def array(self, name: str, value: object, shape: tuple[int, ...], why: str = "") -> Array:
        """Return an array of finite numbers of a shape; one of zeros after noting why not."""
        found = self._numbers(name, value, f"an array of shape {shape}")
        if found is not None and found.shape != shape:
            self.refuse(name, f"expected shape {shape}{why}, got {found.shape}")
            found = None
        return frozen(np.zeros(shape)) if found is None else found

    def compliance(self, name: str, value: object, size: int) -> Array:
        """Return a symmetric positive semidefinite matrix; a number c stands for c times the identity."""
        found = self._numbers(name, value, f"a number or a matrix of shape {(size, size)}")
        if found is not None and found.ndim == 0:
            if found < 0:
                self.refuse(name, f"a compliance must not be negative, got {float(found):g}")
            return frozen(np.eye(size) * float(found))
        if found is not None and found.shape != (size, size):
            hint = "; np.diag makes a matrix of its diagonal" if found.shape == (size,) else ""
            self.refuse(name, f"expected a number, or shape {(size, size)}, got {found.shape}{hint}")
        elif found is not None and size and not self._is_semidefinite(name, found):
            found = None
        return frozen(np.zeros((size, size))) if found is None or found.shape != (size, size) else found

    def names(self, name: str, values: Sequence[object]) -> None:
        """Note names that are no names, or stand twice: limits, proofs and tables tell things apart by them."""
        for index, each in enumerate(values):
            if not isinstance(each, str) or not each:
                self.refuse(f"{name}[{index}]", f"expected a name, got {shown(each)}")
            elif each in values[:index]:
                self.refuse(f"{name}[{index}]", f"{shown(each)} is the name of two; give each its own")

    def _numbers(self, name: str, value: object, wanted: str) -> Array | None:
        try:
            found = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError, OverflowError):
            found = None
        if found is None or value is None or isinstance(value, bool | str):
            self.refuse(name, f"expected {wanted}, got {shown(value)}")
            return None
        if not np.all(np.isfinite(found)):
            self.refuse(name, f"expected {wanted} of finite numbers, got {float(found[~np.isfinite(found)][0])}")
            return None
        return found if found is value else frozen(found)

    def _is_semidefinite(self, name: str, matrix: Array) -> bool:
        largest, diagonal = float(np.abs(matrix).max()), np.diag(matrix)
        if np.abs(matrix - matrix.T).max() > SYMMETRY * largest:
            self.refuse(name, "is not symmetric")
        elif np.any(diagonal < 0) or least_scaled_eigenvalue(matrix) < -SEMIDEFINITE:
            smallest = float(np.linalg.eigvalsh(matrix)[0])
            self.refuse(name, f"is not positive semidefinite: its smallest eigenvalue is {smallest:.6g}")
        else:
            return True
        return False
