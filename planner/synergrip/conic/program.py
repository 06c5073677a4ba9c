"""The convex program, as data: minimise ``x'P x / 2 + q'x + constant`` with ``b - A x`` in a product of cones."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from scipy import sparse

from synergrip.archives import NoArchiveError, read_arrays
from synergrip.conic.basis import inverse
from synergrip.conic.rows import Item, Kind
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.files import atomic_path
from synergrip.linalg import Array, Places, frozen
from synergrip.values import Value


@dataclass(frozen=True)
class Block:
    """Consecutive rows that come from one limit: for each knot, for each item, one cone."""

    limit: str
    kind: Kind
    dim: int
    items: tuple[Item, ...]
    first_knot: int
    knots: int
    """How many; of instants between the knots, how many of these."""
    between: bool = False
    """Whether it speaks of instants between the knots."""
    friction: bool = False
    """Whether its cones are friction cones."""

    @property
    def cones(self) -> int:
        """Number of cones."""
        return self.knots * len(self.items)

    @property
    def rows(self) -> int:
        """Number of rows."""
        return self.cones * self.dim

    @property
    def instants(self) -> Places:
        """(cones,) the knot that each cone speaks of; of instants between the knots, which of them."""
        return self.first_knot + np.repeat(np.arange(self.knots), len(self.items))


@naming_arguments
@dataclass(frozen=True, eq=False, repr=False)
class Program(Value):
    """A second-order cone program with a quadratic objective, and what its rows mean.

    The unknowns are the knots' v_k one after the other, or the coefficients of a basis of these, and then the goal's
    scalar when it has one.

    Example:
        >>> program = refused.program  # of an `Infeasible`
        >>> program.A.shape[0] == len(program.b)
        True
    """

    P: sparse.csc_matrix  # (n, n) symmetric, whole
    q: Array  # (n,)
    A: sparse.csc_matrix  # (m, n)
    b: Array  # (m,)
    blocks: tuple[Block, ...]
    knots: int
    n_v: int
    """Unknowns at each knot."""
    box: Array | Callable[[], Array]
    """`variable_bounds`, or what works them out: a proof needs them, an answer rarely does."""
    basis: sparse.csc_matrix | None = None
    """(T n_v, m) orthogonal columns that the knots' unknowns, stacked, are made of; None when they are any."""
    constant: float = 0.0
    """Of the objective, so that its value is the goal's: gaps are measured against it."""

    def __repr__(self) -> str:
        """Return the sizes."""
        cones, limits = sum(block.cones for block in self.blocks), len({block.limit for block in self.blocks})
        return f"Program({len(self.q)} unknowns, {len(self.b)} rows in {cones} cones of {limits} limits)"

    @cached_property
    def variable_bounds(self) -> Array:
        """(n,) every unknown is also bounded by |x| <= these, which the limits imply or no plan exceeds."""
        return self.box() if callable(self.box) else self.box

    def __getstate__(self) -> dict[str, Any]:
        """Go into a pickle or a copy with the numbers, not with all that they are worked out of."""
        return {**self.__dict__, "box": self.variable_bounds}

    def slices(self) -> Iterator[tuple[Block, slice]]:
        """Yield each block with its rows."""
        start = 0
        for block in self.blocks:
            yield block, slice(start, start + block.rows)
            start += block.rows

    @cached_property
    def stretches(self) -> tuple[tuple[Kind, int, slice], ...]:
        """Kind and size of cones with their rows, those of neighbours that are alike together."""
        found: list[tuple[Kind, int, slice]] = []
        for block, rows in self.slices():
            if found and found[-1][:2] == (block.kind, block.dim):
                rows = slice(found.pop()[2].start, rows.stop)
            found.append((block.kind, block.dim, rows))
        return tuple(found)

    def unknowns(self, x: Array) -> Array:
        """Return v (T, n_v) of a solution x (n,)."""
        stacked = x[: self.knots * self.n_v] if self.basis is None else self.basis @ x[: self.basis.shape[1]]
        return np.asarray(stacked).reshape(self.knots, self.n_v)

    def solution(self, v: Array, scalar: float | None = None) -> Array:
        """Return x (n,) of unknowns v (T, n_v), the nearest when they are none of the basis."""
        stacked = v.ravel() if self.basis is None else inverse(self.basis) @ v.ravel()
        x = np.zeros(len(self.q))
        x[: stacked.size] = stacked
        if scalar is not None:
            x[-1] = scalar
        return x

    def objective(self, x: Array) -> float:
        """Return the value of the objective at x (n,)."""
        return float(x @ (self.P @ x) / 2 + self.q @ x + self.constant)

    def save(self, path: str | Path) -> None:
        """Write the exact program to an .npz file, atomically."""
        blocks = [asdict(block) for block in self.blocks]
        header = {"knots": self.knots, "n_v": self.n_v, "constant": self.constant, "blocks": blocks}
        arrays = {
            "q": self.q,
            "b": self.b,
            "variable_bounds": self.variable_bounds,
            "header": np.array(json.dumps(header)),
        }
        matrices = {"P": self.P, "A": self.A} | ({} if self.basis is None else {"basis": self.basis})
        for name, matrix in matrices.items():
            arrays |= {f"{name}_data": matrix.data, f"{name}_indices": matrix.indices, f"{name}_indptr": matrix.indptr}
        with atomic_path(Path(path)) as temporary, temporary.open("wb") as stream:
            np.savez_compressed(stream, **arrays)  # type: ignore[arg-type]

    @classmethod
    def load(cls, path: str | Path) -> Program:
        """Read a program written by `save`.

        Raises:
            InputError: there is no such file, or something else is in it.
        """
        unreadable = (NoArchiveError, LookupError, ValueError, TypeError)
        try:
            return cls._read(Path(path))
        except InputError as error:
            raise InputError.at("", f"'{path}' holds no saved program ({error.issues[0].message})") from None
        except unreadable as error:
            reason = str(error) or type(error).__name__
            raise InputError.at("", f"'{path}' holds no saved program ({reason})") from error

    @classmethod
    def _read(cls, path: Path) -> Program:
        stored = read_arrays(path, None, "program")
        header: dict[str, Any] = json.loads(str(stored["header"]))
        n, m = len(stored["q"]), len(stored["b"])
        blocks = tuple(
            Block(
                b["limit"], Kind(b["kind"]), b["dim"], tuple(Item(*pair) for pair in b["items"]),
                b["first_knot"], b["knots"], b.get("between", False), b.get("friction", False),
            )
            for b in header["blocks"]
        )  # fmt: skip

        def matrix(name: str, rows: int, columns: int) -> sparse.csc_matrix:
            parts = (stored[f"{name}_data"], stored[f"{name}_indices"], stored[f"{name}_indptr"])
            return sparse.csc_matrix(parts, shape=(rows, columns))

        knots, n_v = header["knots"], header["n_v"]
        basis = matrix("basis", knots * n_v, len(stored["basis_indptr"]) - 1) if "basis_indptr" in stored else None
        return cls(
            matrix("P", n, n), frozen(stored["q"]), matrix("A", m, n), frozen(stored["b"]), blocks,
            knots, n_v, frozen(stored["variable_bounds"]), basis, header.get("constant", 0.0),
        )  # fmt: skip
