"""Which kernel solves a batch of cone programs."""

from __future__ import annotations

from synergrip.batch import numpy_kernel
from synergrip.batch.decided import Solver


def chosen(count: int) -> Solver:
    """Return the kernel for so many problems."""
    return numpy_kernel.solve
