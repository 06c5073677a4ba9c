"""Arguments that are missing, misspelt or without a name, and classes not to be made so: told as all mistakes are."""

from __future__ import annotations

from abc import ABC
from collections.abc import Callable, Iterator, Mapping
from functools import wraps
from inspect import Parameter, signature
from typing import Any, ClassVar, Self, TypeVar

from synergrip.documents.judging import article
from synergrip.documents.validation import shown
from synergrip.errors import InputError, Issue, suggest

Made = TypeVar("Made", bound=Callable[..., Any])
C = TypeVar("C", bound=type[Any])


def naming_arguments(made: Made) -> Made:
    """Return a function, method or class that raises an `InputError` where Python raises one about its arguments.

    Nothing is looked at before a TypeError has been raised, and one from further inside stays what it is.
    """
    if isinstance(made, type):
        made.__init__ = _naming(made.__init__, made.__name__)  # type: ignore[misc]
        return made
    return _naming(made, "")  # type: ignore[return-value]


def made_by(call: str) -> Callable[[C], C]:
    """Return a decorator of a class that nobody makes by hand: what its arguments lack is told by what makes it.

    Args:
        call: what does, such as ``load_problem("barrett-ball-hold")``.
    """

    def decorated(made: C) -> C:
        made.__init__ = _naming(made.__init__, made.__name__, f"is not made by hand; {call} returns one")
        return made

    return decorated


class Finished:
    """Classes that say at once, and by name, which of their methods are still to be written."""

    _example: ClassVar[str]
    """One of its kinds, for who makes what all kinds have in common."""

    def __new__(cls, *_: Any, **__: Any) -> Self:
        """Refuse to make a value of a class that leaves methods to others.

        Raises:
            InputError: with the methods that are left out.
        """
        missing = sorted(getattr(cls, "__abstractmethods__", ()))
        if missing and ABC in cls.__bases__:
            message = f"has nothing but what its kinds share; make one, such as {cls._example}, or write one with"
            raise InputError.at(cls.__name__, f"{message} {', '.join(missing)}")
        if missing:
            raise InputError.at(cls.__name__, f"has no method {' and none '.join(map(repr, missing))}; write it")
        return super().__new__(cls)


def _naming(function: Callable[..., Any], of: str, instead: str = "") -> Callable[..., Any]:
    @wraps(function)
    def called(*args: Any, **kwargs: Any) -> Any:
        try:
            return function(*args, **kwargs)
        except TypeError:
            issues = list(_misnamed(function, of, args, kwargs))
            if not issues:
                raise
            raise InputError([Issue(instead, of)] if instead else issues) from None

    return called


def _misnamed(
    function: Callable[..., Any], of: str, args: tuple[Any, ...], kwargs: Mapping[str, Any]
) -> Iterator[Issue]:
    """Yield what is wrong with the names of arguments, which a method gets after itself.

    A class says in ``_elsewhere`` where arguments belong that people look for in it.
    """
    elsewhere: Mapping[str, str] = getattr(args[0], "_elsewhere", {}) if args else {}
    every = [each for each in signature(function).parameters.values() if each.kind is not Parameter.VAR_KEYWORD]
    if every and every[0].name in ("self", "cls"):
        every, args = every[1:], args[1:]
    places = [each.name for each in every if each.kind is Parameter.POSITIONAL_OR_KEYWORD]
    given, known = set(places[: len(args)]), [each.name for each in every]
    before, unnamed = f"{of}." if of else "", max(len(args) - len(places), 0)
    if unnamed:
        left = [each.name for each in every if each.name not in given and each.name not in kwargs]
        yield Issue(_too_many(args, unnamed, every, left), of)
    meant = [name for name in known if name not in given and name not in kwargs][:unnamed]
    for name in kwargs:
        if name not in known:
            near = f"; {elsewhere[name]}" if name in elsewhere else suggest(name, known)
            meant += [each for each in known if f"'{each}'" in near]
            hint = near or (f"; there are {', '.join(known)}" if known else "; it takes none")
            yield Issue(f"no such argument{hint}", f"{before}{name}", on_key=True)
        elif name in given:
            yield Issue("given twice, by its place and by its name", f"{before}{name}", on_key=True)
    needed = [each.name for each in every if each.default is Parameter.empty]
    for name in (each for each in needed if each not in given and each not in kwargs and each not in meant):
        yield Issue(f"missing{_within(args, needed)}", f"{before}{name}", on_key=True)


def _too_many(values: tuple[Any, ...], unnamed: int, every: list[Parameter], left: list[str]) -> str:
    """Return what to do with values that have no place; `left` are the names that no value has yet."""
    if not every:
        return f"it takes no arguments, got {len(values)}"
    first, names = every[0], ", ".join(each.name for each in every)
    if len(every) == 1 and unnamed < len(values):
        several = any(word in str(first.annotation) for word in ("tuple", "Numbers", "Sequence", "Array"))
        together = f"; put them into one: {first.name}=({', '.join(map(shown, values))})" if several else ""
        return f"it takes one value, {first.name}, got {len(values)}{together}"
    if len(values) > unnamed and len(left) >= unnamed:  # some had their place, and most people go on in the order
        named = ", ".join(f"{name}={shown(value)}" for name, value in zip(left, values[-unnamed:], strict=False))
        return f"{'a value' if unnamed == 1 else f'{unnamed} values'} without a name; write for example {named}"
    if not left:
        return f"it takes {len(every)} values, {names}, got {len(values)}"
    what = "a value" if unnamed == 1 else f"{unnamed} values"
    return f"{what} without a name; write {first.name}=...{f' and so on: {names}' if len(every) > 1 else ''}"


def _within(args: tuple[Any, ...], needed: list[str]) -> str:
    """Return a hint when one value was given in which all that is needed can be found, such as a problem."""
    whole = next((each for each in args if len(needed) > 1 and all(hasattr(each, name) for name in needed)), None)
    if whole is None:
        return ""
    word = type(whole).__name__.lower()
    return f"; {article(type(whole).__name__)} has them: write {', '.join(f'{word}.{name}' for name in needed)}"
