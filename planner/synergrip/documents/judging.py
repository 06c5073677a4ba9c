"""Arguments judged as the values of a file are, for everything that is made in Python."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field, fields, is_dataclass
from numbers import Real
from typing import Any, TypeGuard

import numpy as np

from synergrip.documents.validation import LARGEST_NUMBER, shown
from synergrip.errors import Issue, raise_issues
from synergrip.linalg import Array, frozen

REAL = "iuf"
"""Kinds of arrays whose entries are numbers that can be put in order."""


@dataclass
class Arguments:
    """Returns each argument as it is to be kept, and collects what is wrong with them."""

    of: str
    """What the arguments belong to, in front of their names; empty for those of a function."""
    issues: list[Issue] = field(default_factory=list)

    def refuse(self, name: str, message: str) -> None:
        """Note that an argument is wrong."""
        self.issues.append(Issue(message, key=f"{self.of}.{name}" if self.of else name))

    def finish(self) -> None:
        """Raise an `InputError` of all that is wrong, if anything is."""
        raise_issues(self.issues)

    def number(
        self, name: str, value: object, *, above: float | None = None, at_least: float | None = None,
        unit: str = "", hint: str = "", infinite: bool = False,
    ) -> float:  # fmt: skip
        """Return a number; 1 after noting why it is none, or beyond its bound.

        Args:
            name: of the argument.
            value: what came.
            above: bound that it must exceed.
            at_least: bound that it must not fall below.
            unit: for the message, such as ``m``.
            hint: what to try when it is beyond its bound.
            infinite: whether infinity is a number here.
        """
        wanted = f"a number{f' in {unit}' if unit else ''}"
        if not is_number(value):
            self.refuse(name, f"expected {wanted}, got {described(value)}")
            return 1.0
        found = float(value)  # type: ignore[arg-type]
        if np.isnan(found) or (np.isinf(found) and not infinite):
            self.refuse(name, f"expected {wanted} that is finite, got {found}")
        elif LARGEST_NUMBER < abs(found) < np.inf:
            self.refuse(name, f"{found:g} is too large")
        elif above is not None and not found > above:
            self.refuse(name, f"must be greater than {above:g}, got {found:g}{hint}")
        elif at_least is not None and found < at_least:
            self.refuse(name, f"must be {at_least:g} or more, got {found:g}{hint}")
        else:
            return found
        return 1.0

    def array(
        self, name: str, value: object, shape: tuple[int, ...], why: str = "", *, infinite: bool = False
    ) -> Array:
        """Return a read-only array of finite numbers of a shape; one of zeros after noting why not."""
        found = self.numbers(name, value, f"an array of shape {shape}", infinite=infinite)
        if found is not None and found.shape != shape:
            self.refuse(name, f"expected shape {shape}{why}, got {found.shape}")
            found = None
        return frozen(np.zeros(shape)) if found is None else found

    def numbers(self, name: str, value: object, wanted: str, *, infinite: bool = False) -> Array | None:
        """Return an array of finite numbers, None after noting why not."""
        found = as_numbers(value)
        if found is None:
            self.refuse(name, f"expected {wanted}, got {described(value)}")
            return None
        if found.size and not float(np.abs(found).max()) <= LARGEST_NUMBER:  # nan is none, either
            bad = np.isnan(found) if infinite else ~np.isfinite(found)
            if np.any(bad):
                self.refuse(name, f"expected {wanted} of finite numbers, got {float(found[bad][0])}")
                return None
            largest = float(np.abs(found[np.isfinite(found)]).max(initial=0.0))
            if largest > LARGEST_NUMBER:
                self.refuse(name, f"{largest:g} is too large")
                return None
        own = found is value and not found.flags.writeable and found.flags.owndata  # else somebody else may change it
        return found if own else frozen(np.array(found))

    def text(self, name: str, value: object, *, empty: bool = True) -> str:
        """Return a text; an empty one after noting that it is none, or that it is empty where it must not be."""
        if isinstance(value, str) and (value or empty):
            return value
        self.refuse(name, f"expected a {'text' if empty else 'name'}, got {described(value)}")
        return ""

    def names(self, name: str, values: Sequence[object]) -> None:
        """Note names that are no names, or stand twice: limits, proofs and tables tell things apart by them."""
        for index, each in enumerate(values):
            if not isinstance(each, str) or not each:
                self.refuse(f"{name}[{index}]", f"expected a name, got {described(each)}")
            elif each in values[:index]:
                self.refuse(f"{name}[{index}]", f"{shown(each)} is the name of two; give each its own")

    def named(self, name: str, values: object, count: int, what: str) -> tuple[str, ...]:
        """Return a name for each of `count` things as a tuple, after noting names that are none or stand twice."""
        if not is_list(values):
            self.refuse(name, f"expected {count} names, one for each {what}, got {described(values)}")
            return ()
        self.names(name, values)
        if len(values) != count and not self.issues:
            self.refuse(name, f"expected {count} names, one for each {what}, got {len(values)}")
        return tuple(values)

    def one(self, name: str, value: object, of: type[Any], example: str) -> Any:
        """Return a value of a type; None after noting that it is none."""
        if not isinstance(value, of):
            self.refuse(name, f"expected {article(of.__name__)} such as {example}, got {described(value)}")
        elif lacking := unfinished(value):
            self.refuse(name, lacking)
        else:
            return value
        return None

    def several(self, name: str, value: object, of: type[Any], example: str) -> tuple[Any, ...]:
        """Return a sequence of values of a type as a tuple, without those noted to be of another."""
        if not is_list(value):
            self.refuse(name, f"expected a list such as [{example}], got {described(value)}")
            return ()
        if all(issubclass(kind, of) and not _fields_of(kind) for kind in {type(each) for each in value}):
            return tuple(value)  # as names are: without fields, none of which can be missing
        found = [self.one(f"{name}[{index}]", each, of, example) for index, each in enumerate(value)]
        return tuple(each for each in found if each is not None)


def unfinished(value: Any) -> str:
    """Return what a value lacks whose class has an `__init__` of its own that leaves the inherited one out."""
    kind = type(value)
    left = next((name for name in _fields_of(kind) if not hasattr(value, name)), "")
    return left and f"{article(kind.__name__)} without {left}; call super().__init__(...) in its __init__"


_FIELDS: dict[type, tuple[str, ...]] = {}
"""Names of the fields of each class that a value was judged of: they are asked for again and again."""


def _fields_of(kind: type) -> tuple[str, ...]:
    """Return the names of the fields of a class; none where it is no dataclass."""
    if kind not in _FIELDS:
        _FIELDS[kind] = tuple(each.name for each in fields(kind)) if is_dataclass(kind) else ()
    return _FIELDS[kind]


def described(value: object) -> str:
    """Return what came, for a message: a number or a text itself, of anything else what it is."""
    if isinstance(value, np.number) and not np.iscomplexobj(value) and not isinstance(value, np.timedelta64):
        return f"{float(value):g}"
    if value is None or isinstance(value, bool | int | float | str | list | tuple | dict):
        return shown(value)
    if isinstance(value, type):
        return f"the class {value.__name__} itself; make one with {value.__name__}(...)"
    if isinstance(value, np.ndarray):
        of = "" if value.dtype.kind in REAL else f" of {value.dtype}"
        return f"an array of shape {value.shape}{of}{' with masked entries' if np.ma.is_masked(value) else ''}"
    return article(type(value).__name__)


def article(word: str) -> str:
    """Return a word with "a" or "an" in front."""
    return f"{'an' if word[:1] in 'AEIOUaeiou' else 'a'} {word}"


def expected(name: str, value: object, of: type[Any], example: str) -> None:
    """Refuse the argument of a function that is not of its type.

    Raises:
        InputError: with its name, what came and an example.
    """
    judge = Arguments("")
    judge.one(name, value, of, example)
    judge.finish()


def is_list(value: object) -> TypeGuard[Sequence[Any]]:
    """Return whether a value is a list, a tuple or the like: no text, no array, nothing that is gone once read."""
    kind = type(value)  # as most are; the question whether a class is a Sequence takes ten times as long
    return kind is tuple or kind is list or (isinstance(value, Sequence) and not isinstance(value, str | bytes))


def is_word(value: object, words: Collection[str]) -> bool:
    """Return whether a value is one of some words; an array is none, and compares to none."""
    return isinstance(value, str) and value in words


def is_whole(value: object) -> TypeGuard[int]:
    """Return whether a value is a whole number by its type: `True` is none, nor is a span of time."""
    return isinstance(value, int | np.integer) and not isinstance(value, bool | np.timedelta64)


def is_number(value: object) -> bool:
    """Return whether a value is one real number: `True`, texts, complex numbers and lists of one number are none."""
    if isinstance(value, bool | str | bytes | list | tuple) or value is np.ma.masked:
        return False
    if isinstance(value, np.ndarray | np.generic) and (value.ndim or value.dtype.kind not in REAL):
        return False
    try:
        float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        return False
    return True


def are_floats(values: Iterable[object]) -> bool:
    """Return whether all are arrays of floats, as those that the library makes are."""
    return all(type(each) is np.ndarray and each.dtype == np.float64 for each in values)


def are_texts(values: Iterable[object]) -> bool:
    """Return whether all are texts."""
    return {str}.issuperset(map(type, values))


def as_numbers(value: object) -> Array | None:
    """Return real numbers as an array of floats; None for anything else, masked entries too, which are no numbers."""
    if type(value) is np.ndarray and value.dtype == np.float64:  # as most are that the library makes itself
        return value
    if isinstance(value, list | tuple) and any(isinstance(each, np.ma.MaskedArray) for each in value):
        value = np.ma.array(value)
    if value is None or isinstance(value, bool | str | bytes) or np.ma.is_masked(value):
        return None
    try:
        given = np.asarray(value)
        entries = given.ravel() if given.dtype.kind == "O" else ()
        if given.dtype.kind not in f"{REAL}O" or not all(
            isinstance(each, Real) and is_number(each) for each in entries
        ):
            # an empty list is an array of floats, and one of booleans says yes or no and not how much
            return None
        return given.astype(np.float64, copy=False)
    except (TypeError, ValueError, OverflowError):
        return None
