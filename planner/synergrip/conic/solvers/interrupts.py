"""Ctrl-C while a compiled solver runs, which would hear of it only when it is through."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def interruptible() -> Iterator[Callable[[object], bool]]:
    """Yield a callback for the solver to ask, after each iteration, whether to stop.

    Signals reach Python code in the main thread only, and a program that handles them itself is left alone: the
    callback then never asks to stop.

    Raises:
        KeyboardInterrupt: at the end, when somebody interrupted meanwhile.
    """
    pressed: list[int] = []
    main = threading.current_thread() is threading.main_thread()
    if not main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield lambda _: False
        return
    signal.signal(signal.SIGINT, lambda number, _: pressed.append(number))
    try:
        yield lambda _: bool(pressed)
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if pressed:
        raise KeyboardInterrupt
