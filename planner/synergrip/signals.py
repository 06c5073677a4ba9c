"""Signals that would stop the program in the middle of what must not be half done."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

ENDING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
"""What asks a program to end and lets it finish a thought."""


@contextmanager
def held_back(*numbers: int) -> Iterator[None]:
    """Hold back signals, `ENDING` when none are named, until the block is through; then they do what they would have.

    Blocks may stand in each other. Python hears signals in its main thread only; in another nothing is done. What is
    ignored stays so, and so does a handler that is not Python's.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    heard: list[int] = []
    before = {number: signal.getsignal(number) for number in numbers or ENDING}
    handled = {number: each for number, each in before.items() if each is not None and each != signal.SIG_IGN}
    try:
        for number in handled:
            signal.signal(number, lambda number, _: heard.append(number))
        yield
    finally:
        for number, handler in handled.items():
            signal.signal(number, handler)
        for number in dict.fromkeys(heard):
            signal.raise_signal(number)
