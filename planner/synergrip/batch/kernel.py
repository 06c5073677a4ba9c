"""Which kernel solves a batch of cone programs: the compiled one where Numba is there and it repays, else NumPy's."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec

from synergrip.batch import fast_kernel, fast_statics, numpy_kernel
from synergrip.batch.compiling import Compiled
from synergrip.batch.decided import Solver
from synergrip.documents.judging import is_word
from synergrip.errors import InputError, one_of
from synergrip.grasps.stack import GraspStack

LOADED = 20_000
"""Problems for which it repays to load the compiled kernel (two seconds), where it is kept on the disk."""
COMPILED = 200_000
"""Problems for which it repays to compile it, once on a machine (half a minute)."""
STATICS_COMPILED = 1_000_000
"""Grasps for which it repays to compile their statics, too (a minute)."""
QuickStatics = Callable[[GraspStack], fast_statics.Clear | None]
KERNELS = ("numpy", "numba")


def chosen(count: int, kernel: str | None = None) -> Solver:
    """Return the kernel for so many problems, or the one of a name.

    Raises:
        InputError: there is no such kernel, or Numba is not installed.
    """
    if kernel is not None and not is_word(kernel, KERNELS):
        raise InputError.at("kernel", one_of(kernel, KERNELS))
    if kernel == "numba" and not _numba():
        raise InputError.at("kernel", "'numba' needs Numba: pip install 'synergrip[fast]'")
    return fast_kernel.solve if _used(fast_kernel.compiled, count, COMPILED, kernel) else numpy_kernel.solve


def quick_statics(count: int, kernel: str | None = None) -> QuickStatics | None:
    """Return what works out the statics of many grasps by compiled lanes; None where that does not repay."""
    used = _used(fast_statics.compiled, count, STATICS_COMPILED, kernel)
    return fast_statics.ClearStatics() if used else None


def _numba() -> bool:
    return find_spec("numba") is not None


def _used(what: Compiled, count: int, compiled: int, kernel: str | None) -> bool:
    """Return whether something compiled is used: where it is asked for, or repays the time until it is there."""
    if kernel is not None or not _numba():
        return kernel == "numba"
    return what.loaded or count >= compiled or (count >= LOADED and what.kept())
