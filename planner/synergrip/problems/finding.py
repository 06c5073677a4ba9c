"""Where a problem is that somebody names: a file, or one of those that ship with the package."""

from __future__ import annotations

from collections.abc import Sequence
from os.path import exists, isdir, isfile  # unlike those of Path, no error for a name that is too long
from pathlib import Path

from synergrip.errors import InputError, Issue, one_of, suggest
from synergrip.files import bundled
from synergrip.plain_file import neighbours

SUFFIXES = (".toml", ".json")
"""Of files that hold a problem."""


def bundled_problems() -> tuple[str, ...]:
    """Return the names of the problems that ship with the package."""
    return tuple(sorted(path.stem for path in bundled("problems").glob("*.toml")))


def is_bundled(path: Path) -> bool:
    """Tell whether a file is one of the problems that ship with the package, known by their names."""
    return path.parent == bundled("problems") and path.stem in bundled_problems()


def find_problem(name_or_path: str) -> Path:
    """Return the file of a problem.

    Raises:
        InputError: there is neither such a file nor a bundled problem of that name.
    """
    path, names = Path(name_or_path), bundled_problems()
    if path.suffix or (exists(path) and not isdir(path)):  # pipes and devices are refused as what they are
        if not exists(path) and (meant := _shipped(path, names)):
            message = f"problem file '{path}' not found; did you mean '{meant}'?"
            raise InputError([Issue(message, file=str(path))])
        return path
    inside = bundled("problems") / f"{name_or_path}.toml"
    if not isfile(inside):
        beside = [f"{name_or_path}{suffix}" for suffix in SUFFIXES if isfile(f"{name_or_path}{suffix}")]
        if beside:
            message = f"no such file, and no such bundled problem: '{name_or_path}'; did you mean '{beside[0]}'?"
            raise InputError.at("PROBLEM", message)
        raise InputError.at("PROBLEM", f"no such file, and no such bundled problem: {one_of(name_or_path, names)}")
    return inside


def _shipped(path: Path, names: Sequence[str]) -> str:
    """Return the bundled problem that a file is meant to be that is not there, if no file beside it is nearer."""
    try:
        beside = neighbours(path)
    except OSError:
        return ""
    shipped = {f"{name}{path.suffix}": name for name in names}
    near = suggest(path.name, [*beside, *shipped])
    return next((name for file, name in shipped.items() if file not in beside and f"'{file}'" in near), "")
