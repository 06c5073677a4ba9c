"""The server of a viewer, for this machine alone. The only module that imports viser."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Iterator
from typing import Any

HERE = "127.0.0.1"


@contextlib.contextmanager
def serving(port: int = 0) -> Iterator[Any]:
    """Serve on a port of this machine alone, without a word, for as long as the block runs.

    Args:
        port: the first one that is tried; 0 for any that is free.
    """
    import viser

    with contextlib.redirect_stdout(io.StringIO()):
        server = viser.ViserServer(host=HERE, port=port, verbose=False)
    try:
        yield server
    finally:
        with contextlib.redirect_stdout(io.StringIO()):
            server.stop()
