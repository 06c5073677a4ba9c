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
COMPILED = 100_000
"""Problems for which it repays to compile it, once on a machine (about ten seconds)."""
STATICS_COMPILED = 1_000_000
"""Grasps for which it repays to compile their statics, too (half a minute)."""
QuickStatics = fast_statics.ClearStatics
KERNELS = ("numpy", "numba")


def chosen(count: int, kernel: str | None = None) -> Solver:
    """Return the kernel for so many problems, or the one of a name.

    Raises:
        InputError: there is no such kernel, or Numba is not installed.
    """
    if kernel is not None and not is_word(kernel, KERNELS):
        raise InputError.at("kernel", one_of(kernel, KERNELS))
    if kernel == "numba" and not _numba():
        raise InputError.at(
            "kernel", "'numba' needs Numba, which is not installed: pip install 'synergrip[fast]' (or numba alone)"
        )
    return fast_kernel.solve if _used(fast_kernel.compiled, count, COMPILED, kernel) else numpy_kernel.solve


def name_of(solver: Solver) -> str:
    """Return the name of a kernel."""
    return "numba" if solver is fast_kernel.solve else "numpy"


def reason(count: int, kernel: str | None) -> str:
    """Return why that kernel is taken for so many problems."""
    if kernel is not None:
        return "asked for"
    if not _numba():
        return "Numba is not installed"
    if fast_kernel.compiled.loaded:
        return "Numba's is loaded already"
    if count < LOADED:  # and Numba is not imported to know more
        return f"it takes {LOADED:,} tasks to load Numba's, and {COMPILED:,} to compile it"
    if fast_kernel.compiled.kept():
        return f"{LOADED:,} tasks are enough to load Numba's"
    return f"Numba's is not compiled yet on this machine; {COMPILED:,} tasks are enough to do so"


def quick_statics(stack: GraspStack, count: int, kernel: str | None = None) -> QuickStatics | None:
    """Return what works out the statics of many grasps by compiled lanes; None where that does not repay."""
    used = _used(fast_statics.compiled, count, STATICS_COMPILED, kernel)
    return fast_statics.ClearStatics(stack) if used else None


def ready(solver: Solver, quick: QuickStatics | None, whole: object, tell: Callable[[str, float], None]) -> None:
    """Compile or load what is used, and tell that it is, before any task is looked at.

    Raises:
        KeyboardInterrupt: somebody interrupted meanwhile.
    """
    if solver is fast_kernel.solve:
        fast_kernel.compiled.ready(tell)
    if quick is not None and isinstance(whole, GraspStack):
        quick.ready(whole, tell)


def _numba() -> bool:
    return find_spec("numba") is not None


def _used(what: Compiled, count: int, compiled: int, kernel: str | None) -> bool:
    """Return whether something compiled is used: where it is asked for, or repays the time until it is there."""
    if kernel is not None or not _numba():
        return kernel == "numba"
    return what.loaded or count >= compiled or (count >= LOADED and what.kept())
