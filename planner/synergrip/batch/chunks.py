"""Chunks of tasks worked out one after the other, or several at a time on threads; told in their order.

NumPy and the compiled kernel let other threads run while they reckon. Every chunk is the same arithmetic on the same
numbers wherever it runs, so that the answers do not depend on the number of threads, to the last digit.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

import numpy as np

from synergrip.documents.judging import described, is_whole
from synergrip.errors import InputError

MOST = 1024
"""Threads: more than any machine has cores for."""
LARGE = 31 << 20
"""Bytes: the largest block by which the C library of Linux learns what it need not give back."""
C = TypeVar("C")
R = TypeVar("R")


def keep_memory() -> None:
    """Have the arrays of one chunk made where those of the last one were.

    The C library of Linux gives memory back to the system when large arrays are dropped, and gets it again page by
    page: a tenth to a seventh of the time. Once a block has been freed that was as large as it ever gives back at
    once, it keeps twice as much. Nothing is written to this one, so that it costs nothing; elsewhere it does nothing.
    """
    np.empty(LARGE, dtype=np.uint8)


def on_threads(chunks: Sequence[C], work: Callable[[C], R], threads: int) -> Iterator[tuple[C, R]]:
    """Yield every chunk, in their order, and what `work` makes of it.

    When nobody asks for more, or something is raised, chunks that no thread has begun are dropped, and those under
    way are waited for.
    """
    if threads == 1 or len(chunks) == 1:
        for chunk in chunks:
            yield chunk, work(chunk)
        return
    from concurrent.futures import ThreadPoolExecutor

    pool = ThreadPoolExecutor(min(threads, len(chunks)), thread_name_prefix="synergrip")
    try:
        waiting = deque((chunk, pool.submit(work, chunk)) for chunk in chunks)
        while waiting:
            chunk, done = waiting.popleft()
            yield chunk, done.result()
    finally:
        pool.shutdown(cancel_futures=True)


def threads_asked(value: object) -> int:
    """Return the number of threads that somebody asks for.

    Raises:
        InputError: no whole number from 1 to `MOST`.
    """
    if not is_whole(value) or not 1 <= value <= MOST:
        raise InputError.at("threads", f"expected a whole number of threads from 1 to {MOST}; got {described(value)}")
    return int(value)
