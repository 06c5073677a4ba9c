"""Re-checks in exact arithmetic that a task has no plan: python check_proof.py proof.json [SHA-256 of its problem]."""

import hashlib
import json
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

Vector = list[Fraction]


def dot(one: Any, other: Any) -> Fraction:
    """Return the sum of products."""
    return sum((a * b for a, b in zip(one, other, strict=True) if a and b), Fraction(0))


def times(A: Any, x: Any) -> Vector:
    """Return A x."""
    return [dot(row, x) for row in A]


def turned(A: Any) -> list[Vector]:
    """Return A'."""
    return [list(column) for column in zip(*A, strict=True)]


def product(A: Any, B: Any) -> list[Vector]:
    """Return A B."""
    return [times(turned(B), row) for row in A]


def plus(*parts: Any) -> Any:
    """Return the sum of vectors, or of matrices."""
    return [plus(*each) if isinstance(each[0], list) else sum(each) for each in zip(*parts, strict=True)]


def solved(A: list[Vector], B: list[Vector]) -> tuple[list[Vector], int]:
    """Return X and d > 0 with A X = d B, by elimination in whole numbers, in which no division leaves a rest."""
    rows, d = [], 1
    for row in map(list.__add__, A, B):
        by = max(each.denominator for each in row)  # all are powers of two
        rows.append([int(each * by) for each in row])
    for k in range(len(rows)):
        chosen = next(i for i in range(k, len(rows)) if rows[i][k])
        rows[k], rows[chosen] = rows[chosen], rows[k]
        before, d, top = d, rows[k][k], rows[k]
        for i in set(range(len(rows))) - {k}:
            rows[i] = [(d * x - rows[i][k] * y) // before for x, y in zip(rows[i], top, strict=True)]
    return [[Fraction(each if d > 0 else -each) for each in row[len(rows) :]] for row in rows], abs(d)


def weighed(limit: Any, knot: int, y: Vector, on: list[dict[str, Vector]]) -> Fraction:
    """Add the multipliers of a cone to what is `on` the quantities of each knot, and return what they make of b."""
    at, b = knot - limit["first_knot"], limit["plus"]
    if not 0 <= at < limit["knots"] or y[0] < 0 or y[0] ** 2 < dot(y[1:], y[1:]):
        raise ValueError("no multipliers of this cone")
    for lag, weights in [(0, [1] * limit["knots"]), *limit["earlier"]]:
        for row, of, index, factor in limit["terms"]:
            if min(row, index, lag, knot - lag) < 0:
                raise ValueError("a place before the first")
            on[knot - lag][of][index] += y[row] * factor * weights[at]
    return dot(y, b[at] if len(b) > 1 else b[0])


def checked(document: Any) -> Fraction:
    """Return the most that the limits, each times its multiplier, add up to; with a plan it is 0 at least."""
    p, none = document["problem"], [Fraction(0)]
    G, J, S, box, w, w_0 = (p[name] for name in ("G", "J", "S", "box", "wrench", "w_0"))
    n, n_q, n_z, give = len(J), len(S), len(box), plus(p["C_q"], product(product(S, p["C_z"]), turned(S)))
    C = plus(p["C_s"], product(product(J, give), turned(J)))  # of a grasp dq = S dz_r - give dtau,
    A = [*map(list.__add__, C, turned(G)), *(row + 6 * none for row in G)]  # C dlambda + G' motion = J S dz_r,
    of_dw = [n_z * none + [Fraction(-(i == j)) for j in range(6)] for i in range(6)]  # and G dlambda = -dw
    maps, d = solved(A, [row + 6 * none for row in product(J, S)] + of_dw)
    of_dz, of_dw = [row[:n_z] for row in maps], [row[n_z:] for row in maps]
    start = times(of_dw[:n], w_0) if p["lambda_0"] is None else [d * each for each in p["lambda_0"]]
    sizes = {"force": n, "torque": n_q, "joint": n_q, "effort": n_z, "reference": n_z, "motion": 6, "displacement": 6}
    on = [{name: size * none for name, size in sizes.items()} for _ in w]
    total = d * sum(weighed(p["limits"][i], knot, y, on) for i, knot, y in document["multipliers"])
    for its, load in zip(on, w, strict=True):
        force = plus(its["force"], times(J, plus(its["torque"], times(S, its["effort"]))))
        change = plus(force, times(J, times(turned(give), [-each for each in its["joint"]])))
        sag = times(of_dw, [a - b for a, b in zip(load, w_0, strict=True)])
        total += dot(force, start) + dot(change + its["displacement"], sag)
        of_maps = times(turned(of_dz), change + plus(its["motion"], its["displacement"]))
        directly = plus(its["reference"], times(turned(S), its["joint"]))
        total += sum(abs(a + d * b) * abs(z) for a, b, z in zip(of_maps, directly, box, strict=True))
    return Fraction(total / d)


if __name__ == "__main__":
    text, of = Path(sys.argv[1]).read_text(encoding="utf-8"), [*sys.argv[2:], ""][0]
    written = json.loads(text)
    parts = [json.dumps(written[key], sort_keys=True).encode() for key in ("problem", "multipliers")]
    marks = [hashlib.sha256(part).hexdigest() for part in parts]
    if written["sha256"] != marks or of not in ("", marks[0]):
        sys.exit(f"no proof: altered since it was written, or of another problem, that of SHA-256 {marks[0]}")
    value = checked(json.loads(text, parse_float=lambda each: Fraction(float(each)), parse_constant=Fraction))
    print(f"sum = {float(value):.6g}: {'proof holds' if value < 0 else 'no proof'}, problem of SHA-256 {marks[0]}")
    sys.exit(value >= 0)
