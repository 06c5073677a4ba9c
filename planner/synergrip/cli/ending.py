"""Ctrl-C at any moment: exit code 130 and one line, without a traceback.

An exception in the middle of an import, a destructor or compiled code may be swallowed there or turned into another.
So the program leaves at once, from the signal's handler, wherever there is nothing to keep. While files are written a
signal waits (`synergrip.signals`), and where finished work is to be kept it is the exception that the library knows
(`heard` in `cli/running.py`). Nothing of this holds before `watch` has run, so this file imports next to nothing.
"""

from __future__ import annotations

import _signal as signal  # type: ignore[import-not-found]  # all of it that counts, without its enums: 5 ms sooner
import _thread
import atexit
import os
import sys

TYPE_CHECKING = False  # that of typing
if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType
    from typing import NoReturn

INTERRUPTED = 130
_kept: list[str] = []
_document: Callable[[str], str] | None = None


def watch() -> None:
    """Hear the interrupts of this process from now on, unless it was started so that it ignores them."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, leave)
        sys.unraisablehook = _raise_again
        atexit.register(signal.signal, signal.SIGINT, signal.SIG_IGN)  # all is done: nothing is left to interrupt


def watching() -> bool:
    """Return whether this process is the command line and hears interrupts."""
    return sys.unraisablehook is _raise_again


def leave(number: int = 0, frame: FrameType | None = None) -> NoReturn:
    """Say that it was interrupted and what stands, and leave at once with exit code 130."""
    message = f"interrupted; {standing()}"
    stream, text = (2, message) if _document is None else (1, _document(message))
    try:  # noqa: SIM105 (contextlib is not there yet)
        os.write(stream, f"{text}\n".encode(errors="replace"))
    except OSError:  # nobody is there to be told
        pass
    os._exit(INTERRUPTED)


def end(code: object) -> None:
    """Leave now when the program was interrupted and all is said; all being said, an interrupt is none any more.

    The interpreter would go on to die of the signal when the interrupt passed through its own code in C.
    """
    if not watching():
        return
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if code == INTERRUPTED:
        os._exit(INTERRUPTED)


def begin(document: Callable[[str], str] | None) -> None:
    """Begin a verb, whose last words `document` makes the one JSON document on standard output; None for text."""
    global _document
    _kept.clear()
    _document = document


def asks_document() -> bool:
    """Return whether one JSON document is asked for that standard output does not have yet."""
    return _document is not None


def keep(*names: object) -> None:
    """Remember what has been written, to be named when it is all there is."""
    _kept.extend(map(str, names))


def printing() -> None:
    """From here on standard output has its document."""
    global _document
    _document = None


def standing() -> str:
    """Return what has been written, in words."""
    return f"written and kept: {', '.join(_kept)}" if _kept else "nothing was written"


def _raise_again(unraisable: sys.UnraisableHookArgs) -> None:
    """Let an interrupt that fell into a destructor, where exceptions vanish, be heard after it; so not from here."""
    if issubclass(unraisable.exc_type, KeyboardInterrupt):
        _thread.start_new_thread(_thread.interrupt_main, ())
    else:
        sys.__unraisablehook__(unraisable)
