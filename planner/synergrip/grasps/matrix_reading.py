"""Matrices of a file: lists of numbers become arrays, and every objection names its entry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import chain

import numpy as np

from synergrip.documents.validation import shown
from synergrip.errors import Issue
from synergrip.linalg import Array, frozen

NO_LOAD = 1e-12  # N: a wrench that counts as none
BALANCE = 1e-6  # how far w_0 may be from -G lambda_0, relative
LARGEST_SIDE = 1000  # rows or columns
MOST_ISSUES = 20  # of one matrix
LARGEST_COMPLIANCE = 1e9  # m/N, rad/(N m): nothing that yields more holds anything
SYMMETRY = 1e-9  # relative to the largest entry
SEMIDEFINITE = 1e-10  # relative, after scaling to unit diagonal


@dataclass(frozen=True)
class Count:
    """A number of rows or columns that is known from elsewhere."""

    number: int
    reason: str = ""
    """What it follows from."""

    def refusal(self, what: str, got: object) -> str:
        """Return the message for `got` of them instead."""
        return f"expected {self.number} {what}, got {got}" + (f" ({self.reason})" if self.reason else "")


@dataclass
class MatrixReader:
    """Reads matrices and vectors, and collects what is wrong with them."""

    issues: list[Issue] = field(default_factory=list)

    def refuse(self, key: str, message: str) -> None:
        """Note that `key` is wrong."""
        self.issues.append(Issue(message, key=key))

    def matrix(self, key: str, value: object, rows: Count | None = None, columns: Count | None = None) -> Array | None:
        """Return the (rows, columns) matrix, or None after noting why not; a count of None is free."""
        if not isinstance(value, list) or not value:
            self.refuse(key, f"expected a matrix: a list of rows, got {shown(value) if value != [] else 'no rows'}")
            return None
        if any(not isinstance(row, list) for row in value):
            bad = [i for i, row in enumerate(value) if not isinstance(row, list)]
            if len(bad) == len(value):
                self.refuse(
                    key, f"expected a matrix: a list of rows such as [[1, 0], [0, 1]], got a list of {len(value)}"
                )
                bad = []
            for i in bad[:MOST_ISSUES]:
                self.refuse(f"{key}[{i}]", f"expected a row of numbers, got {shown(value[i])}")
            return None
        if rows is not None and len(value) != rows.number:
            self.refuse(key, rows.refusal("rows", len(value)))
            return None
        if not self._rectangular(key, value, columns) or not self._numbers(key, value):
            return None
        return frozen(value)

    def vector(self, key: str, value: object, length: Count) -> Array | None:
        """Return the vector of `length`, or None after noting why not."""
        if not isinstance(value, list):
            self.refuse(key, length.refusal("numbers", shown(value)))
        elif len(value) != length.number:
            self.refuse(key, length.refusal("numbers", len(value)))
        elif self._entries(key, value):
            return frozen(value)
        return None

    def compliance(self, key: str, value: object, size: Count | None) -> Array | None:
        """Return a symmetric positive semidefinite matrix; a number c stands for c times the identity.

        A `size` of None is unknown because something else was wrong; the matrix is judged all the same.
        """
        if not isinstance(value, list):
            if isinstance(value, bool) or not isinstance(value, int | float):
                self.refuse(key, f"expected a number or a matrix, got {shown(value)}")
            elif value < 0:
                self.refuse(key, f"a compliance must not be negative, got {value}")
            elif value > LARGEST_COMPLIANCE:
                self.refuse(key, f"a compliance of {value:g} is too large")
            elif size is not None:
                return frozen(np.eye(size.number) * float(value))
            return None
        square = size if size is not None or not value else Count(len(value), "a compliance is square")
        matrix = self.matrix(key, value, square, square)
        if matrix is None or not self._symmetric(key, matrix) or not self._semidefinite(key, matrix):
            return None
        if (largest := float(np.diag(matrix).max())) > LARGEST_COMPLIANCE:
            self.refuse(key, f"a compliance of {largest:g} is too large")
            return None
        return frozen((matrix + matrix.T) / 2)

    def _rectangular(self, key: str, value: list[list[object]], columns: Count | None) -> bool:
        lengths = [len(row) for row in value]
        wanted = columns or Count(max(set(lengths), key=lengths.count))
        if wanted.number == 0:
            self.refuse(key, "has no columns")
        elif max(len(value), *lengths) > LARGEST_SIDE:
            self.refuse(key, f"is larger than {LARGEST_SIDE} rows or columns")
        elif len(set(lengths)) == 1 and lengths[0] != wanted.number:
            self.refuse(key, wanted.refusal("columns", lengths[0]))
        else:
            short = [i for i, length in enumerate(lengths) if length != wanted.number]
            for i in short[:MOST_ISSUES]:
                self.refuse(f"{key}[{i}]", wanted.refusal("numbers in this row", lengths[i]))
            return not short
        return False

    def _numbers(self, key: str, value: list[list[object]]) -> bool:
        if set(map(type, chain.from_iterable(value))) <= {int, float}:
            return True
        before = len(self.issues)
        for i, row in enumerate(value):
            if len(self.issues) - before < MOST_ISSUES:
                self._entries(f"{key}[{i}]", row)
        return False

    def _entries(self, key: str, row: Sequence[object]) -> bool:
        bad = [i for i, entry in enumerate(row) if type(entry) not in (int, float)]
        for i in bad[:MOST_ISSUES]:
            self.refuse(f"{key}[{i}]", f"expected a number, got {shown(row[i])}")
        return not bad

    def _symmetric(self, key: str, matrix: Array) -> bool:
        difference = np.abs(matrix - matrix.T)
        i, j = (int(k) for k in np.unravel_index(np.argmax(np.tril(difference)), matrix.shape))
        if difference[i, j] <= SYMMETRY * np.abs(matrix).max():
            return True
        pair = f"entry [{i}][{j}] is {matrix[i, j]:.9g}, entry [{j}][{i}] is {matrix[j, i]:.9g}"
        self.refuse(f"{key}[{i}][{j}]", f"{key} is not symmetric: {pair}")
        return False

    def _semidefinite(self, key: str, matrix: Array) -> bool:
        diagonal = np.diag(matrix)
        if np.any(diagonal < 0):
            i = int(np.argmin(diagonal))
            smallest = np.linalg.eigvalsh(matrix)[0]
            message = f"{key} is not positive semidefinite: its smallest eigenvalue is {smallest:.6g}"
            self.refuse(f"{key}[{i}][{i}]", f"{message}; this entry of the diagonal is negative")
            return False
        if is_semidefinite(matrix):
            return True
        smallest = np.linalg.eigvalsh(matrix)[0]
        self.refuse(key, f"is not positive semidefinite: its smallest eigenvalue is {smallest:.6g}")
        return False


def is_semidefinite(matrix: Array) -> bool:
    """Tell whether a symmetric matrix without a negative diagonal is semidefinite, scaled to unit diagonal."""
    diagonal = np.diag(matrix)
    if not np.any(matrix - np.diag(diagonal)):
        return True
    scale = np.sqrt(np.where(diagonal > 0, diagonal, np.abs(matrix).max() or 1.0))
    scaled = matrix / np.outer(scale, scale)
    try:  # many times as fast as eigenvalues; it ends at the first pivot that is not positive
        np.linalg.cholesky(scaled + SEMIDEFINITE * np.eye(len(scaled)))
    except np.linalg.LinAlgError:
        return False
    return True


def unbalanced(G: Array, lambda_0: Array, w_0: Array) -> str:
    """Return how far w_0 is from the ``-G lambda_0`` that contact forces at the start balance; empty when it is not."""
    residual = w_0 + G @ lambda_0
    size = np.linalg.norm(w_0) + np.linalg.norm(np.abs(G) @ np.abs(lambda_0))
    if np.linalg.norm(residual) <= BALANCE * size + NO_LOAD:
        return ""
    worst = int(np.argmax(np.abs(residual)))
    name = ("f_x", "f_y", "f_z", "m_x", "m_y", "m_z")[worst]
    unit = "N" if worst < 3 else "N m"
    return f"w_0 = -G lambda_0 does not hold: {name} is off by {residual[worst]:.6g} {unit}"
