"""What all tests share."""

from __future__ import annotations

import signal


def pytest_configure() -> None:
    """Hear interrupts: a run in the background of a script is started deaf to them, and so is what it starts."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
