"""The response maps of a grasp in decimal arithmetic of 80 digits: the equations of equilibrium, nothing eliminated."""

from __future__ import annotations

from decimal import Decimal, localcontext

import numpy as np

from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array

DIGITS = 80
Row = list[Decimal]


def decimal_maps(grasp: Grasp, held: Array | None = None) -> dict[str, Array]:
    """Return the nine maps, rounded to float64 at the very end.

    Unknown are lambda, u, q, z (as many as rows): ``C_s lambda + G' u - J q = 0``, ``G lambda = -w``,
    ``q - S z + C_q tau = 0`` and ``z + C_z sigma = z_r`` with ``tau = J' lambda`` and ``sigma = S' tau``.
    Where the object is free to move, u is made of the columns of `held` (6, r) alone, and only these are balanced.
    """
    held = np.eye(6) if held is None else held
    m = held.shape[1]
    with localcontext() as context:
        context.prec = DIGITS
        G, J, S, C_s, C_q, C_z = (_exact(getattr(grasp, name)) for name in ("G", "J", "S", "C_s", "C_q", "C_z"))
        G = _product(_transposed(_exact(held), 6, m), G)
        n_l, n_q, n_z = grasp.n_l, grasp.n_q, grasp.n_z
        torque, effort = _transposed(J, n_l, n_q), _product(_transposed(S, n_q, n_z), _transposed(J, n_l, n_q))
        zero = Decimal(0)
        rows: list[Row] = []
        for i in range(n_z):  # z first: its pivots are 1 and cost nothing
            row = _row(_product([C_z[i]], effort)[0], [zero] * m, [zero] * n_q, _unit(i, n_z))
            rows.append(row + _unit(i, n_z) + [zero] * m)
        for i in range(n_q):
            row = _row(_product([C_q[i]], torque)[0], [zero] * m, _unit(i, n_q), [-x for x in S[i]])
            rows.append(row + [zero] * (n_z + m))
        for i in range(n_l):
            row = _row(C_s[i], [line[i] for line in G], [-x for x in J[i]], [zero] * n_z)
            rows.append(row + [zero] * (n_z + m))
        for i in range(m):
            row = _row(G[i], [zero] * m, [zero] * n_q, [zero] * n_z)
            rows.append(row + [zero] * n_z + [-x for x in _unit(i, m)])
        solved = _solved(rows)
        z, q, force, u = (solved[a:b] for a, b in _slices((n_z, n_q, n_l, m)))
        tau, sigma = _product(torque, force), _product(effort, force)
        both = {"dlambda": force, "du": u, "dq": q, "dtau": tau, "dsigma": sigma, "dz": z}
        maps = {f"{name}_dzr": _rounded(values, 0, n_z) for name, values in both.items()}
        maps |= {f"{name}_dw": _rounded(both[name], n_z, n_z + m) @ held.T for name in ("dlambda", "du", "dq")}
        return maps | {name: held @ maps[name] for name in ("du_dzr", "du_dw")}


def yields_everywhere(grasp: Grasp) -> bool:
    """Return whether the compliances of contacts, joints and synergies leave no contact direction rigid."""
    with localcontext() as context:
        context.prec = DIGITS
        J, S, C_s, C_q, C_z = (_exact(getattr(grasp, name)) for name in ("J", "S", "C_s", "C_q", "C_z"))
        n_l, n_q, n_z = grasp.n_l, grasp.n_q, grasp.n_z
        yielding = _sum(C_q, _product(S, _product(C_z, _transposed(S, n_q, n_z)))) if n_z else C_q
        C = _sum(C_s, _product(J, _product(yielding, _transposed(J, n_l, n_q))))
        left, largest = set(range(n_l)), max(C[i][i] for i in range(n_l))
        while left:  # C is semidefinite: its largest diagonal entry is a pivot
            pick = max(left, key=lambda i: C[i][i])
            if C[pick][pick] <= largest * Decimal(10) ** -40:
                return False
            left.remove(pick)
            for i in left:
                factor = C[i][pick] / C[pick][pick]
                C[i] = [x - factor * p for x, p in zip(C[i], C[pick], strict=True)]
        return True


def _sum(first: list[Row], second: list[Row]) -> list[Row]:
    return [[a + b for a, b in zip(*rows, strict=True)] for rows in zip(first, second, strict=True)]


def _row(force: Row, u: Row, q: Row, z: Row) -> Row:
    return [*z, *q, *force, *u]


def _slices(sizes: tuple[int, ...]) -> list[tuple[int, int]]:
    ends = [sum(sizes[: i + 1]) for i in range(len(sizes))]
    return [(end - size, end) for end, size in zip(ends, sizes, strict=True)]


def _exact(matrix: Array) -> list[Row]:
    return [[Decimal(float(x)) for x in row] for row in matrix]


def _unit(i: int, size: int) -> Row:
    return [Decimal(int(i == j)) for j in range(size)]


def _transposed(matrix: list[Row], rows: int, columns: int) -> list[Row]:
    return [[matrix[i][j] for i in range(rows)] for j in range(columns)]


def _product(left: list[Row], right: list[Row]) -> list[Row]:
    columns = range(len(right[0]) if right else 0)
    return [[sum((a * b[j] for a, b in zip(row, right, strict=True) if a), Decimal(0)) for j in columns]
            for row in left]  # fmt: skip


def _rounded(rows: list[Row], start: int, end: int) -> Array:
    return np.array([[float(x) for x in row[start:end]] for row in rows]).reshape(len(rows), end - start)


def _solved(rows: list[Row]) -> list[Row]:
    """Return X of ``A X = B`` for rows (A, B), by elimination; the pivot is the largest for its own row."""
    count = len(rows)
    for k in range(count):
        sizes = [abs(row[k]) / max(map(abs, row[k:count])) if any(row[k:count]) else Decimal(0) for row in rows[k:]]
        pick = k + max(range(count - k), key=sizes.__getitem__)
        rows[k], rows[pick] = rows[pick], rows[k]
        pivot = rows[k]
        for i in range(k + 1, count):
            if rows[i][k]:
                factor = rows[i][k] / pivot[k]
                rows[i] = [Decimal(0)] * (k + 1) + [
                    x - factor * p if p else x for x, p in zip(rows[i][k + 1 :], pivot[k + 1 :], strict=True)
                ]
    solved: list[Row] = [[] for _ in rows]
    for k in reversed(range(count)):
        right = rows[k][count:]
        for j in range(k + 1, count):
            if rows[k][j]:
                right = [r - rows[k][j] * x for r, x in zip(right, solved[j], strict=True)]
        solved[k] = [r / rows[k][k] for r in right]
    return solved
