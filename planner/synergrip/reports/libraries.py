"""Libraries that only a part of the reports needs, and that may not be installed."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.util import find_spec

from synergrip.errors import InputError


def refuse_without(libraries: Mapping[str, str], what: str) -> None:
    """Raise an `InputError` where a library is not installed, before anything is done.

    Args:
        libraries: how each is imported, and how it is called.
        what: needs them.
    """
    missing = [called for name, called in libraries.items() if find_spec(name) is None]
    if missing:
        have = "are" if len(missing) > 1 else "is"
        message = f"the {what} needs {' and '.join(missing)}, which {have} not installed: pip install 'synergrip[view]'"
        raise InputError.at(what, message)
