"""Arguments of limits and goals, judged as the values of a problem file are."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import wraps
from inspect import isfunction
from typing import Any

import numpy as np

from synergrip.documents.judging import Arguments, as_numbers, described, is_number
from synergrip.documents.naming import Finished
from synergrip.documents.validation import LARGEST_NUMBER
from synergrip.errors import InputError, SynergripError
from synergrip.linalg import Array, frozen

OneOrEach = Any
"""A number for all, or one for each of some; arrays (n,) once the grasp is known."""
PLURALS = {"joint": "joints", "synergy": "synergies", "contact": "contacts"}


def size(key: str, value: Any, wanted: str, *, above: float = -math.inf, at_least: float = -math.inf) -> float:
    """Return a finite number as it is to be kept.

    Args:
        key: limit or goal with its argument, for example ``ElasticMotion.limit``.
        value: what was given.
        wanted: what is expected, in words.
        above: what it must be greater than.
        at_least: what it must not be less than.

    Raises:
        InputError: no such number.
    """
    fits = is_number(value) and abs(value) <= LARGEST_NUMBER and value > above and value >= at_least
    if not fits:
        raise InputError.at(key, f"expected {wanted}, got {described(value)}")
    return float(value)


def judge_closeness(of: str, exact: object, stiffest: object) -> None:
    """Refuse what says neither yes nor no, or no largest entry of a Hessian.

    Raises:
        InputError: with the goal and the argument.
    """
    judge = Arguments(of)
    if not isinstance(exact, bool):
        judge.refuse("exact", f"expected True or False, got {described(exact)}")
    judge.number("stiffest", stiffest, above=0, infinite=True)
    judge.finish()


def sizes(key: str, value: Any, of: str) -> Array:
    """Return one size for all or one for each, all greater than 0; infinity stands for no bound.

    Args:
        key: limit or goal with its argument.
        value: a number, or a sequence of them.
        of: what there is one of for each: "joint", "synergy" or "contact".

    Raises:
        InputError: no numbers, or numbers that are no sizes.
    """
    found = numbers(key, value, of)
    if (found > 0).all():
        return found
    if np.any(np.isnan(found)):
        raise InputError.at(key, "expected numbers, got nan; infinity stands for no bound")
    raise InputError.at(key, f"expected sizes greater than 0, got {float(np.min(found)):g}")


def numbers(key: str, value: Any, of: str) -> Array:
    """Return a number for all, (), or numbers for each, (n,); arrays that are kept already stay what they are.

    Raises:
        InputError: something else.
    """
    wanted = f"a number, or one for each {of}"
    found = as_numbers(value)
    if found is None:
        raise InputError.at(key, f"expected {wanted}, got {described(value)}")
    if found.ndim > 1 or not found.size:
        raise InputError.at(key, f"expected {wanted}, got an array of shape {found.shape}")
    if not np.abs(found).max() <= LARGEST_NUMBER and np.any((np.abs(found) > LARGEST_NUMBER) & ~np.isinf(found)):
        raise InputError.at(key, f"{np.abs(found)[np.isfinite(found)].max():g} is too large")
    own = found is value and not found.flags.writeable and found.flags.owndata
    return found if own else frozen(np.array(found))


def one_each(key: str, value: Array, names: Sequence[str], of: str) -> Array:
    """Return one number for each name (n,), after noting that there are as many.

    Raises:
        InputError: more numbers or fewer.
    """
    if value.ndim and value.shape != (len(names),):
        message = (
            f"expected {len(names)} numbers, one for each of the {PLURALS[of]} {', '.join(names)}; got {len(value)}"
        )
        raise InputError.at(key, message)
    return value if value.ndim else frozen(np.full(len(names), float(value)))


ASKED = ("rows", "usage", "objective", "bounded")
"""Methods of limits and goals of one's own in which errors are theirs."""


class Complete(Finished):
    """Classes that say at once, and by name, which of their methods are still to be written, or went wrong."""

    def __init_subclass__(cls, **others: Any) -> None:
        """Let the methods of a class outside this package say whose they are when they fail."""
        super().__init_subclass__(**others)
        if is_own(cls):
            for name in ASKED:
                if isfunction(method := cls.__dict__.get(name)):
                    setattr(cls, name, _saying_whose(method, name))


def is_own(cls: type) -> bool:
    """Return whether a class is a user's own."""
    return not cls.__module__.startswith("synergrip.")


def _saying_whose(method: Callable[..., Any], name: str) -> Callable[..., Any]:
    """Return a method whose errors name its class, with the original behind them."""

    @wraps(method)
    def called(self: Any, *args: Any, **kwargs: Any) -> Any:
        key = f"{type(self).__name__}.{name}"
        try:
            return method(self, *args, **kwargs)
        except InputError as error:
            if all(issue.key.startswith(key) for issue in error.issues):  # said by the same method of a base
                raise
            raise InputError(error.under(key).issues) from error
        except SynergripError:
            raise
        except Exception as error:
            raise InputError.at(key, f"raised {type(error).__name__}: {error}") from error

    return called
