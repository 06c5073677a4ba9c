"""Calls with missing, unknown or misspelt arguments, refused in the same words as everything else that is wrong."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

from synergrip.errors import InputError, Issue, suggest

Called = TypeVar("Called", bound=Callable[..., Any])


def spelled(called: Called) -> Called:
    """Return a function, or a class whose values are made by calling it, that says which of its arguments is wrong.

    Python's own `TypeError` about the arguments becomes an `InputError`; nothing else changes, and calls that fit cost
    nothing. Goes above ``@dataclass``.
    """
    made: Any = called
    if not isinstance(made, type):
        function: Called = _judging(made, made.__name__, skipped=0)
        return function
    setattr(made, "__init__", _judging(getattr(made, "__init__"), made.__name__, skipped=1))  # noqa: B009, B010
    return called


def _judging(function: Any, name: str, skipped: int) -> Any:
    @wraps(function)
    def judged(*args: Any, **kwargs: Any) -> Any:
        try:
            return function(*args, **kwargs)
        except TypeError as error:
            issues = _misfits(inspect.signature(function), name, args, kwargs, skipped)
            if not issues:
                raise  # it is not the call that does not fit
            raise InputError(issues) from error

    return judged


def _misfits(
    signature: inspect.Signature, name: str, args: tuple[Any, ...], kwargs: dict[str, Any], skipped: int
) -> list[Issue]:
    """Return what is wrong with the arguments of a call; nothing when they fit."""
    try:
        signature.bind(*args, **kwargs)
    except TypeError:
        pass
    else:
        return []
    every = list(signature.parameters.values())[skipped:]
    names = [parameter.name for parameter in every]
    issues = [
        Issue(f"no such argument of {name}; it has {', '.join(names)}{suggest(given, names)}", key=f"{name}.{given}")
        for given in kwargs
        if given not in names
    ]
    ordered = [each for each in every if each.kind in (each.POSITIONAL_ONLY, each.POSITIONAL_OR_KEYWORD)]
    given = args[skipped:]
    if len(given) > len(ordered):
        most = f"at most {len(ordered)}" if ordered else "none"
        message = f"takes {most} without a name, got {len(given)}; write them as {', '.join(f'{n}=...' for n in names)}"
        issues.append(Issue(message, key=name))
    placed = {each.name for each in ordered[: len(given)]}
    issues += [Issue("is given twice, by its place and by its name", key=f"{name}.{n}") for n in placed & kwargs.keys()]
    missing = [each.name for each in every if each.default is each.empty and each.kind is not each.VAR_KEYWORD]
    issues += [
        Issue(f"missing; {name} needs {', '.join(missing)}", key=f"{name}.{each}")
        for each in missing
        if each not in placed and each not in kwargs
    ]
    return issues
