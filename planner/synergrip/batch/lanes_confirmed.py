"""Statics of eight grasps confirmed by their own equations, in lanes; nothing here knows how they were found.

A linear map that meets an equation on a vector of no particular direction meets it on all (R. Freivalds, 1977): what
costs a product of matrices to work out costs two products with a vector to confirm. Imported only where Numba is there.
"""

from __future__ import annotations

from typing import Any

from synergrip.batch.lanes import all_of, kept_apart, load, root, store, where_less
from synergrip.batch.lanes_algebra import compiled, larger
from synergrip.batch.lanes_dense import Matrix, squares_of

EQUAL = 1e-9
"""By how much of the largest term two sides of an equation may differ."""
REGULAR = 1e7
"""How many times the sizes of M and of its inverse, with rows made as long, may make at most."""


@compiled
def _applied(w: Any, out: int, A: Any, x: int, m: int, n: int) -> None:
    """Write A x (m) for A (m, n)."""
    kept_apart()
    for i in range(m):
        total, row = all_of(0.0), A.first + i * A.down
        for j in range(n):
            total = total + load(w, row + j * A.right) * load(w, x + j)
        store(w, out + i, total)


@compiled
def _nothing(rest: Any, whole: Any) -> Any:
    """Return 1 where the squares of a rest are nothing beside others, else 0; 0 also where one is no number."""
    return where_less(rest, all_of(EQUAL * EQUAL) * whole + all_of(1e-300), all_of(1.0), all_of(0.0))


@compiled
def _equal(w: Any, a: int, b: int, c: int, force: int, l: int) -> Any:  # noqa: E741
    """Return 1 where motions a (n_l) of contacts are those of b and c together, in scaled coordinates, else 0."""
    kept_apart()
    rest, of_a, of_b, of_c = all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)
    for i in range(l):
        over = all_of(1.0) / load(w, force + i)
        x, y, z = over * load(w, a + i), over * load(w, b + i), over * load(w, c + i)
        rest, of_a, of_b, of_c = rest + (x - y - z) * (x - y - z), of_a + x * x, of_b + y * y, of_c + z * z
    return _nothing(rest, larger(of_a, larger(of_b, of_c)))


@compiled
def confirmed(w: Any, at: Any, chances: Any) -> Any:
    """Return 1 where maps and bases are those of the grasps: forces, motions, what synergies control; else 0.

    Args:
        w: the workspace, with the numbers of the grasps and what was found; the rest is written over.
        at: where these are.
        chances: normal numbers: for references, wrench, internal forces and rigid motions one after the other.
    """
    return _balanced(w, at, chances) * _controlled(w, at, chances[at.z + 6 :])


@compiled
def _balanced(w: Any, at: Any, chances: Any) -> Any:
    """Return 1 where forces hold the load and contacts, joints and synergies yield by them, else 0. (7)-(16)."""
    kept_apart()
    l, q, z, k = at.l, at.q, at.z, at.k  # noqa: E741 - the usual letter
    both, answer = at.turned, at.turned + k
    tau = answer + at.n + 6
    sigma, moved, yielding = tau + q, tau + q + z, tau + 2 * q + z
    of_hand = yielding + q
    of_contacts, of_object = of_hand + l, of_hand + 2 * l
    squares = all_of(0.0)
    for i in range(l):
        squares = squares + squares_of(w, at.maps + i * k, z)
    over = all_of(1.0) / root(squares)
    for j in range(z):
        store(w, both + j, over * all_of(chances[j]))
    for j in range(6):
        store(w, answer + j, all_of(chances[z + j]))
    _applied(w, both + z, Matrix(at.motion, 1, 6), answer, 6, 6)
    _applied(w, answer, Matrix(at.maps, k, 1), both, at.n, k)
    _applied(w, tau, Matrix(at.J, 1, q), answer, q, l)
    _applied(w, sigma, Matrix(at.S, 1, z), tau, z, q)
    _applied(w, moved, Matrix(at.C_z, z, 1), sigma, z, z)
    for j in range(z):
        store(w, sigma + j, load(w, both + j) - load(w, moved + j))
    _applied(w, moved, Matrix(at.S, z, 1), sigma, q, z)
    _applied(w, yielding, Matrix(at.C_q, q, 1), tau, q, q)
    for i in range(q):
        store(w, tau + i, load(w, moved + i) - load(w, yielding + i))
    _applied(w, of_hand, Matrix(at.J, q, 1), tau, l, q)
    _applied(w, of_contacts, Matrix(at.C_s, l, 1), answer, l, l)
    _applied(w, of_object, Matrix(at.G, 1, l), answer + l, l, 6)
    fits = _equal(w, of_hand, of_contacts, of_object, at.force, l)
    joints = answer + l + 6 + q + 2 * z
    rest = all_of(0.0)
    for i in range(q):
        part = load(w, tau + i) - load(w, joints + i)
        rest = rest + part * part
    fits = fits * _nothing(rest, larger(squares_of(w, moved, q), squares_of(w, yielding, q)))
    return fits * _held(w, at, answer, both + z, tau)


@compiled
def _held(w: Any, at: Any, forces: int, wrench: int, left: int) -> Any:
    """Return 1 where contact forces hold a load (6), else 0; what is left of it is written down."""
    l = at.l  # noqa: E741 - the usual letter
    _applied(w, left, Matrix(at.G, l, 1), forces, 6, l)
    for i in range(6):
        store(w, left + i, load(w, left + i) + load(w, wrench + i))
    rest = squares_of(w, left, 3)
    for i in range(3):  # the moment about the centroid, over the length
        about = load(w, left + 3 + i)
        for j in range(3):
            about = about - load(w, at.motion + 6 * j + 3 + i) * load(w, left + j)
        about = about / load(w, at.motion + 21)
        rest = rest + about * about
    whole = all_of(0.0)
    for i in range(l):
        part = load(w, forces + i) * load(w, at.force + i)
        whole = whole + part * part
    return _nothing(rest, whole)


@compiled
def _regular(w: Any, at: Any, chances: Any) -> Any:
    """Return 1 where M is far from singular and its inverse is that, else 0; and the squares of its longest row."""
    kept_apart()
    z = at.z
    own, references, back = at.rest, at.rest + z, at.rest + 2 * z
    right, beside, most = all_of(1.0), all_of(0.0), all_of(0.0)
    for j in range(z):  # with rows made as long, the root of their number is the size of M
        row, column = squares_of(w, at.M + j * z, z), all_of(0.0)
        for i in range(z):
            part = load(w, at.inverse + i * z + j)
            column = column + part * part
        beside, most = beside + row * column, larger(most, row)
        right = where_less(all_of(0.0), row, right, all_of(0.0))
        store(w, own + j, root(row) * all_of(chances[j]))
    right = where_less(beside * all_of(float(z)), all_of(REGULAR * REGULAR), right, all_of(0.0))
    _applied(w, references, Matrix(at.inverse, z, 1), own, z, z)
    _applied(w, back, Matrix(at.M, z, 1), references, z, z)
    rest = all_of(0.0)
    for j in range(z):
        part = (load(w, back + j) - load(w, own + j)) / root(squares_of(w, at.M + j * z, z))
        rest = rest + part * part
    return right * _nothing(rest, squares_of(w, references, z)), most


@compiled
def _controlled(w: Any, at: Any, chances: Any) -> Any:
    """Return 1 where bases and M are as Theorem 1 says: forces of E_s alone, and rigid motions; else 0."""
    kept_apart()
    l, q, z, k, r, d = at.l, at.q, at.z, at.k, at.r, at.d  # noqa: E741
    alpha, dz_r, forces = at.turned, at.turned + 6 + r, at.turned + 6 + r + z
    made, motion = forces + l, forces + 2 * l + z
    of_hand = motion + 6 + q
    of_object, nothing = of_hand + l, of_hand + 2 * l
    for j in range(r):
        store(w, alpha + j, all_of(chances[j]))
    _applied(w, dz_r, Matrix(at.inverse, z, 1), alpha, z, r)
    _applied(w, forces, Matrix(at.E_s, r, 1), alpha, l, r)
    _applied(w, made, Matrix(at.maps, k, 1), dz_r, l, z)
    rest, whole = all_of(0.0), all_of(0.0)
    for i in range(l):
        size, part = load(w, at.force + i), load(w, forces + i)
        apart, part = (load(w, made + i) - part) * size, part * size
        rest, whole = rest + apart * apart, whole + part * part
    regular, most = _regular(w, at, chances)
    right = regular * _nothing(rest, whole)
    if d == 0:
        return right
    _applied(w, made, Matrix(at.maps + l * k, k, 1), dz_r, 6, z)
    _applied(w, motion, Matrix(at.motion, 6, 1), made, 6, 6)
    _applied(w, made, Matrix(at.motion, 1, 6), motion, 6, 6)
    _applied(w, motion, Matrix(at.Gamma_ucs, 1, d), made, d, 6)
    right = right * _nothing(squares_of(w, motion, d), most * squares_of(w, dz_r, z))
    for j in range(d):
        store(w, alpha + j, all_of(chances[r + j]))
    _applied(w, made, Matrix(at.Gamma_zcs, d, 1), alpha, z, d)
    _applied(w, motion, Matrix(at.S, z, 1), made, q, z)
    _applied(w, of_hand, Matrix(at.J, q, 1), motion, l, q)
    _applied(w, made, Matrix(at.Gamma_ucs, d, 1), alpha, 6, d)
    _applied(w, of_object, Matrix(at.G, 1, l), made, l, 6)
    for i in range(l):
        store(w, nothing + i, all_of(0.0))
    return right * _equal(w, of_hand, nothing, of_object, at.force, l)
