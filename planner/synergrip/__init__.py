"""Grasp forces and in-hand motion for robot hands driven by postural synergies.

The public names, in the order of the pipeline, are those of ``__init__.pyi``, which type checkers and editors read
instead of this file; each is loaded when it is first used.
"""

from __future__ import annotations

__version__ = "0.1.0"


def _homes() -> dict[str, str]:
    """Return the module of every public name: lines ``from MODULE import NAME as NAME``."""
    text = __spec__.loader.get_data(f"{__file__}i").decode()  # type: ignore[name-defined]
    lines = (line.split() for line in text.splitlines() if line.startswith("from "))
    return {name: module for _, module, _, name, _, _ in lines}


_HOMES = _homes()

__all__ = ["__version__", *_HOMES]


def __getattr__(name: str) -> object:
    """Import a public name from its home on first use."""
    if name not in _HOMES:
        raise AttributeError(f"module 'synergrip' has no attribute {name!r}")
    from importlib import import_module

    found = globals()[name] = getattr(import_module(_HOMES[name]), name)
    return found


def __dir__() -> list[str]:
    """Return the public names, loaded or not."""
    return list(__all__)
