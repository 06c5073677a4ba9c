"""The statics of many grasps by the compiled lanes: of those where all is clear, and confirmed by the equations."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import accumulate
from typing import Any, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from synergrip.batch.compiling import Compiled, as_rows
from synergrip.grasps.stack import GraspStack, Matrices
from synergrip.linalg import Array
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.each import Each, EachGrasp, EachResponse
from synergrip.statics.saddle import other_numbers
from synergrip.statics.subspaces import Bases
from synergrip.statics.theorem1 import Coordinates

SOURCES = ("lanes.py", "lanes_algebra.py", "lanes_rows.py", "lanes_dense.py", "lanes_bases.py", "lanes_centroid.py",
           "lanes_confirmed.py", "lanes_statics.py", "numpy_kernel.py")  # fmt: skip
"""What the compiled statics are made of."""


class Layout(NamedTuple):
    """Where things are in the workspace of eight grasps, and how many: given, on the way, wanted."""

    l: int  # noqa: E741 - force components, the usual letter
    q: int
    z: int
    k: int
    """Columns of the maps: references and wrench."""
    n: int
    """Rows of the maps."""
    r: int
    """Dimension of E_s."""
    d: int
    """Dimension of Gamma_ucs."""
    G: int
    J: int
    S: int
    C_s: int
    C_q: int
    C_z: int
    motion: int
    force: int
    turned: int
    JS: int
    K: int
    L: int
    Y: int
    R: int
    wide: int
    other: int
    rest: int
    held: int
    heads: int
    along: int
    inner: int
    inner_heads: int
    size: int
    lost: int
    clear: int
    maps: int
    E_s: int
    Gamma_ucs: int
    Gamma_zcs: int
    M: int
    inverse: int
    end: int

    @classmethod
    def of(cls, l: int, q: int, z: int) -> Layout | None:  # noqa: E741
        """Return the layout for so many force components, joints and synergies; None where dimensions say no.

        That is where no internal force is possible, or more than the six rigid motions would cost none.
        """
        r = min(l - 6, z)
        d, k, n = z - r, z + 6, l + 6 + 2 * q + 2 * z
        if r < 1 or d > 6:
            return None
        given = (6 * l, l * q, q * z, l * l, q * q, z * z, 36, l)
        most = max(l, z, 6)
        on_the_way = (6 * l, l * z, q * q, l * l, 6 * l, 36, most * max(q, z, 6), n * k, (l + 6) * k, 6 * l, 12, l * z,
                      most * most, 2 * most)  # fmt: skip
        wanted = (12, 12, 1, n * k, l * r, 6 * d, z * d, z * z, z * z)
        return cls(l, q, z, k, n, r, d, *accumulate((0, *given, *on_the_way, *wanted)))


class Spans(NamedTuple):
    """From where to where rows of matrices, and of transposed ones (T), are not 0: fingers move their own contacts."""

    J: NDArray[np.int64]  # (n_l, 2)
    J_T: NDArray[np.int64]  # (n_q, 2)
    S: NDArray[np.int64]  # (n_q, 2)
    S_T: NDArray[np.int64]  # (n_z, 2)
    C_s: NDArray[np.int64]  # (n_l, 2)
    C_q: NDArray[np.int64]  # (n_q, 2)
    C_z: NDArray[np.int64]  # (n_z, 2)
    L: NDArray[np.int64]  # (n_l,) from where, of the factor of C (`lanes_statics`)
    L_T: NDArray[np.int64]  # (n_l,) of its transpose, from the last row up and the last column back
    R: NDArray[np.int64]  # (6,) of that of the motions, which has no zeros

    @classmethod
    def of(cls, matrices: Matrices) -> Spans:
        """Return those that hold for all of N grasps."""
        every = (matrices.J, matrices.S, matrices.C_s, matrices.C_q, matrices.C_z)
        J, S, C_s, C_q, C_z = (((each[:1] if each.strides[0] == 0 else each) != 0).any(axis=0) for each in every)
        within = J @ (C_q | S @ C_z @ S.T) @ J.T | C_s
        first = np.minimum(within.argmax(axis=1), np.arange(len(J)))
        last = np.array([np.flatnonzero(first <= i)[-1] for i in range(len(J))])
        spans = {"J": J, "J_T": J.T, "S": S, "S_T": S.T, "C_s": C_s, "C_q": C_q, "C_z": C_z}
        starts = {"L": first, "L_T": len(J) - 1 - last[::-1], "R": np.zeros(6, dtype=np.int64)}
        return cls(**{name: _spans(each) for name, each in spans.items()}, **starts)


def _spans(there: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Return (m, 2) from where to where each row (m, k) is true; (k, 0) for one that is nowhere."""
    k = there.shape[1]
    found = np.empty((len(there), 2), dtype=np.int64)
    nowhere = ~there.any(axis=1)
    found[:, 0] = np.where(nowhere, k, there.argmax(axis=1))
    found[:, 1] = np.where(nowhere, 0, k - there[:, ::-1].argmax(axis=1))
    return found


class Clear(NamedTuple):
    """What is clear of the statics of N grasps."""

    places: NDArray[np.intp]
    """Where among the N these grasps are."""
    grasps: GraspStack
    each: Each
    """Their statics, by the names of the maps and bases."""
    like: Analysis
    """That of one such grasp, by NumPy: its subspaces have the same dimensions."""


def _made(stamp: int) -> Any:
    from synergrip.batch.lanes_statics import made

    return made(stamp)


def _prepare(function: Any) -> None:
    """Work out the statics of no grasp at all."""
    none, starts = np.zeros((1, 2), dtype=np.int64), np.zeros(1, dtype=np.int64)
    spans = Spans(none, none, none, none, none, none, none, starts, starts, starts)
    layout, numbers = Layout.of(7, 1, 1), np.zeros(1)
    function((as_rows(np.zeros((1, 1))),) * 8, layout, spans, numbers, numbers, np.zeros((0, 1)), False)


compiled = Compiled("statics", SOURCES, _made, _prepare, "about half a minute")


_KNOWN: WeakKeyDictionary[GraspStack, dict[Layout, Analysis]] = WeakKeyDictionary()
"""What NumPy says of one grasp of each stack that there is: a millisecond, which a few hundred grasps take together."""


class ClearStatics:
    """The statics of the chunks of one stack."""

    def __init__(self, stack: GraspStack) -> None:
        """Make that of a stack."""
        self._like = _KNOWN.setdefault(stack, {})

    @staticmethod
    def ready(stack: GraspStack, tell: Callable[[str, float], None]) -> None:
        """Compile or load it, where grasps of this form may be clear at all."""
        if Layout.of(stack.like.n_l, *stack.like.S.shape) is not None:
            compiled.ready(tell)

    def __call__(self, stack: GraspStack) -> Clear | None:
        """Return what is clear of the statics of many grasps, and confirmed; None where nothing is."""
        layout = Layout.of(stack.like.n_l, *stack.like.S.shape)
        if layout is None:
            return None
        found = np.empty((len(stack), layout.end - layout.clear))
        each = _each(found, layout, stack)
        clear = lanes(stack, layout, found, known=False)
        places = np.flatnonzero(clear)
        if not len(places):
            return None
        if not clear.all():
            stack = stack.taken(places)
            each = _each(found[places], layout, stack)
        like = self._like.get(layout) or self._like.setdefault(layout, analyse(stack[0]))
        return Clear(places, stack, each, like) if like.spaces.dimensions == (layout.r, layout.d, 0) else None


def lanes(stack: GraspStack, layout: Layout, found: Array, *, known: bool) -> NDArray[np.bool_]:
    """Write the statics of grasps into `found`, from `layout.clear` on; return (N,) which are clear, and confirmed.

    Confirmed means that the rows of `found` were read anew and meet the equations of the grasps. Where they are `known`
    that is all that is done.
    """
    matrices = stack.matrices
    arrays = tuple(as_rows(each) for each in (*vars(matrices).values(), stack.metric.motion, stack.metric.force))
    compiled()(arrays, layout, Spans.of(matrices), _others(layout), _chances(layout), found, known)
    return np.asarray(found[:, 0] > 0)


@cache
def _chances(layout: Layout) -> Array:
    return np.random.default_rng(1).normal(size=layout.z + 6 + layout.r + layout.d)


@cache
def _others(layout: Layout) -> Array:
    l, q, z = layout.l, layout.q, layout.z  # noqa: E741
    return np.concatenate([
        other_numbers(np.ones(shape)).ravel() for shape in ((6, l), (l, q), (q, z), (l, l), (q, q), (z, z))
    ])  # fmt: skip


def _each(found: Array, at: Layout, stack: GraspStack) -> Each:
    """Return the numbers that were found by their names."""
    N, start = len(found), at.clear

    def part(first: int, rows: int, columns: int) -> Array:
        return found[:, first - start : first - start + rows * columns].reshape(N, rows, columns)

    maps = part(at.maps, at.n, at.k)
    ends = np.cumsum([at.l, 6, at.q, at.z, at.z, at.q]).tolist()
    rows = [maps[:, first:end] for first, end in zip([0, *ends], ends, strict=False)]
    names = ("dlambda", "du", "dtau", "dsigma", "dz", "dq")
    both = {f"{name}_dzr": rows[i][..., : at.z] for i, name in enumerate(names)}
    both |= {f"{name}_dw": rows[i][..., at.z :] for i, name in enumerate(names) if name not in ("dtau", "dsigma")}
    grasp = EachGrasp(stack.matrices.G, stack.matrices.J, stack.matrices.S, np.zeros((N, at.l)), stack.w_0)
    bases = Bases(
        part(at.E_s, at.l, at.r), part(at.Gamma_ucs, 6, at.d), part(at.Gamma_zcs, at.z, at.d), np.zeros((N, at.z, 0))
    )
    coordinates = Coordinates(part(at.M, at.z, at.z), part(at.inverse, at.z, at.z), (at.r, at.d, 0))
    return Each(EachResponse(**both, grasp=grasp), bases, coordinates, stack.metric)
