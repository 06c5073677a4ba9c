"""Which kernel solves a batch of cone programs: the compiled one where Numba is there and it repays, else NumPy's."""

from __future__ import annotations

from importlib.util import find_spec

from synergrip.batch import fast_kernel, numpy_kernel
from synergrip.batch.decided import Solver
from synergrip.documents.judging import is_word
from synergrip.errors import InputError, one_of

LOADED = 20_000
"""Problems for which it repays to load the compiled kernel (two seconds), where it is kept on the disk."""
COMPILED = 200_000
"""Problems for which it repays to compile it, once on a machine (half a minute)."""
KERNELS = ("numpy", "numba")


def chosen(count: int, kernel: str | None = None) -> Solver:
    """Return the kernel for so many problems, or the one of a name.

    Raises:
        InputError: there is no such kernel, or Numba is not installed.
    """
    if kernel is not None and not is_word(kernel, KERNELS):
        raise InputError.at("kernel", one_of(kernel, KERNELS))
    there = find_spec("numba") is not None
    if kernel == "numba" and not there:
        raise InputError.at("kernel", "'numba' needs Numba: pip install 'synergrip[fast]'")
    if kernel == "numba" or (kernel is None and there and _repays(count)):
        return fast_kernel.solve
    return numpy_kernel.solve


def _repays(count: int) -> bool:
    """Return whether so many problems are worth the time until the compiled kernel is there."""
    loaded = fast_kernel.compiled.cache_info().currsize > 0
    return loaded or count >= COMPILED or (count >= LOADED and fast_kernel.kept())
