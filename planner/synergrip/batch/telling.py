"""How far a long work is, told to a function of whoever asked for it, and seldom enough to cost nothing."""

from __future__ import annotations

import time
from collections.abc import Callable
from inspect import signature

from synergrip.documents.judging import described
from synergrip.errors import InputError

Progress = Callable[[str, float], None]
SELDOM = 0.5
"""[s] that lie between two things told of single tasks, at least."""


class Telling:
    """What is under way, and which share of it is done."""

    def __init__(self, progress: Progress | None) -> None:
        """Judge the function that is to be told; None for nobody.

        Raises:
            InputError: no function, or not one of a text and a share.
        """
        judge_progress(progress)
        self._progress = progress
        self._last = time.monotonic()

    def __call__(self, what: str, share: float) -> None:
        """Tell."""
        self._last = time.monotonic()
        if self._progress is not None:
            self._progress(what, share)

    def seldom(self, what: str, share: float) -> None:
        """Tell, unless something was told less than `SELDOM` ago."""
        if time.monotonic() - self._last >= SELDOM:
            self(what, share)


def judge_progress(progress: object) -> None:
    """Refuse what cannot be told a text and a share; None may be.

    Raises:
        InputError: before anything is worked out.
    """
    wanted = "expected a function of two arguments, a text and the share that is done (0 to 1)"
    if progress is None:
        return
    if not callable(progress):
        raise InputError.at("progress", f"{wanted}; got {described(progress)}")
    try:
        taken = signature(progress)
    except (TypeError, ValueError):  # of some functions in C nobody knows the arguments
        return
    try:
        taken.bind("", 0.0)
    except TypeError as error:
        raise InputError.at("progress", f"{wanted}; got one that takes {taken}") from error
