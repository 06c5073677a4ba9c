"""Arguments that are missing, misspelt or without a name, told as all other mistakes are."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import wraps
from inspect import Parameter, signature
from typing import Any, TypeVar

from synergrip.errors import InputError, Issue, suggest

Made = TypeVar("Made", bound=Callable[..., Any])


def naming_arguments(made: Made) -> Made:
    """Return a function or class that raises an `InputError` where Python would raise a TypeError about its arguments.

    Nothing is looked at before a TypeError has been raised, and one from further inside stays what it is.
    """
    if isinstance(made, type):
        made.__init__ = _naming(made.__init__, made.__name__)  # type: ignore[misc]
        return made
    return _naming(made, "")  # type: ignore[return-value]


def _naming(function: Callable[..., Any], of: str) -> Callable[..., Any]:
    @wraps(function)
    def called(*args: Any, **kwargs: Any) -> Any:
        try:
            return function(*args, **kwargs)
        except TypeError:
            issues = list(_misnamed(function, of, args, kwargs))
            if not issues:
                raise
            raise InputError(issues) from None

    return called


def _misnamed(
    function: Callable[..., Any], of: str, args: tuple[Any, ...], kwargs: Mapping[str, Any]
) -> Iterator[Issue]:
    """Yield what is wrong with the names of arguments; a class passes itself first."""
    every = [each for each in signature(function).parameters.values() if each.kind is not Parameter.VAR_KEYWORD]
    places = [each.name for each in every if each.kind is Parameter.POSITIONAL_OR_KEYWORD]
    given, known = set(places[: len(args)]), [each.name for each in every if each.name != "self"]
    before = f"{of}." if of else ""
    if len(args) > len(places):
        unnamed = len(args) - len(places)
        how = f"write {known[0]}=... and so on: {', '.join(known)}" if known else "it takes no arguments"
        yield Issue(f"{unnamed} values without a name; {how}", of)
    for name in kwargs:
        if name not in known:
            hint = suggest(name, known) or f"; there are {', '.join(known)}"
            yield Issue(f"no such argument{hint}", f"{before}{name}", on_key=True)
        elif name in given:
            yield Issue("given twice, by its place and by its name", f"{before}{name}", on_key=True)
    for each in every:
        if each.default is Parameter.empty and each.name not in given and each.name not in kwargs:
            yield Issue("missing", f"{before}{each.name}", on_key=True)
