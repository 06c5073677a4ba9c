"""Functions that Numba compiles once on a machine, keeps on the disk, and loads from then on; announced before."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from zlib import crc32

import numpy as np

from synergrip.conic.solvers.interrupts import interruptible
from synergrip.linalg import Array
from synergrip.log import LOG

ONCE = ", once on this machine: "


@dataclass
class Compiled:
    """A function that is compiled, or loaded, when it is first asked for."""

    name: str
    """In what is told."""
    sources: Sequence[str]
    """Files it is made of: when one changes, what is kept on the disk is none of it."""
    make: Callable[[int], Any]
    """Returns the function for a stamp of its sources, not yet compiled."""
    prepare: Callable[[Any], None]
    """Calls it with nothing to do, so that it is compiled or loaded."""
    takes: str
    """How long it takes to compile it, in words."""
    loaded: bool = False
    _function: Any = field(default=None, repr=False)

    def __call__(self) -> Any:
        """Return the compiled function."""
        self.ready()
        return self._function

    def ready(self, tell: Callable[[str, float], None] = lambda what, share: None) -> None:
        """Compile or load it, if that is still to be done, and tell which of the two before it begins.

        Raises:
            KeyboardInterrupt: somebody interrupted meanwhile; told when it is compiled or loaded, and kept.
        """
        if not self.loaded:
            self._load(tell)

    def kept(self) -> bool:
        """Return whether its compiled form is kept on the disk."""
        function = self._made()
        folder = function.stats.cache_path
        return bool(folder) and any(Path(folder).glob(f"{function.__module__.rpartition('.')[2]}.made.*.nbi"))

    def _made(self) -> Any:
        if self._function is None:
            folder = Path(__file__).parent
            self._function = self.make(crc32(b"".join((folder / name).read_bytes() for name in self.sources)))
        return self._function

    def _load(self, tell: Callable[[str, float], None]) -> None:
        kept, function, start = self.kept(), self._made(), time.perf_counter()
        told = f"loading the compiled {self.name}: a second or two" if kept else f"compiling the {self.name}{ONCE}"
        told += "" if kept else f"{self.takes} (an interrupt waits for its end)"
        LOG.log(logging.INFO if kept else logging.WARNING, "%s", told)
        tell(told, 0.0)
        with interruptible():  # an interrupt that falls into what the compiler calls back is lost
            self.prepare(function)
            self.loaded = True
        hits = sum(function.stats.cache_hits.values())
        if not hits and not function.stats.cache_path:
            LOG.warning("the compiled %s cannot be kept: no folder for it can be written; it is compiled in every run",
                        self.name)  # fmt: skip
        LOG.info("the %s was %s in %.1f s", self.name, "loaded" if hits else "compiled", time.perf_counter() - start)
        tell(told, 1.0)


def as_rows(values: Array) -> Array:
    """Return (N or 1, entries) numbers one after the other, read-only: one form for a compiled function."""
    whole = values[:1] if values.strides[0] == 0 or len(values) == 1 else values
    flat = np.ascontiguousarray(whole).reshape(len(whole), -1).view()
    flat.setflags(write=False)
    return flat
