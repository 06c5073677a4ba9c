"""Everything that can be refused, with the place, the reason and what to try.

One root, `SynergripError`. `InputError` carries any number of `Issue`s, so that a file is judged as a whole; the
refusals of the statics carry the physical object that explains them (a free twist, a contact component, a direction).
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

MOST_ISSUES = 20
"""Of one error; more than that nobody reads."""
MOST_NAMES = 60
"""Names that a message lists."""
LONGEST_NAME = 80
"""Characters of a name that a message shows."""


@dataclass(frozen=True)
class Issue:
    """One thing that is wrong with an input, and where it stands."""

    message: str
    """What was found and what was expected, without the key in front."""
    key: str = ""
    """Dotted key with indices, for example ``contact[1].model``."""
    file: str = ""
    line: int = 0
    """1-based line, 0 when unknown."""
    column: int = 0
    """1-based column, 0 when unknown."""
    length: int = 1
    """Number of characters to underline."""
    source: str = ""
    """The line of the file, to be shown under the message."""
    on_key: bool = False
    """True when the key itself is at fault and not its value."""

    def __str__(self) -> str:
        """Return one line: file, place, key, message."""
        place = f"{self.file}:{self.line}:{self.column}: " if self.line else f"{self.file}: " if self.file else ""
        return f"{place}{self.key}: {self.message}" if self.key else f"{place}{self.message}"


class SynergripError(Exception):
    """Root of all errors that synergrip raises on purpose.

    Example:
        ``except SynergripError as error: sys.exit(error.exit_code)``
    """

    exit_code = 2

    def __reduce__(self) -> tuple[Callable[..., SynergripError], tuple[object, ...]]:
        """Pickle what it carries, whatever its constructor asks for."""
        return _carrying, (type(self), self.args, self.__dict__)


def _carrying(kind: type[SynergripError], args: tuple[object, ...], carried: dict[str, object]) -> SynergripError:
    """Return the error that was pickled."""
    error = kind.__new__(kind, *args)
    error.args = args
    error.__dict__.update(carried)
    return error


class InputError(SynergripError):
    """Bad input: nothing was solved. Carries every issue found, in file order.

    Example:
        ``except InputError as error: print(error.issues[0].key)``
    """

    def __init__(self, issues: Sequence[Issue]) -> None:
        """Carry `issues`, of which there is at least one; of very many the first ones, and how many more there are."""
        self.issues = _first(issues)
        super().__init__("\n".join(str(issue) for issue in self.issues))

    @classmethod
    def at(cls, key: str, message: str, *, on_key: bool = False) -> InputError:
        """Return the error with one issue at `key`."""
        return cls([Issue(message, key=key, on_key=on_key)])

    def located(self, locate: Callable[[Issue], Issue]) -> InputError:
        """Return the same error with each issue completed by `locate`."""
        return type(self)([locate(issue) for issue in self.issues])

    def under(self, prefix: str) -> InputError:
        """Return the same error with `prefix` in front of every key; issues that have their place already keep it."""
        return type(self)([i if i.file else replace(i, key=_joined(prefix, i.key)) for i in self.issues])


def _first(issues: Sequence[Issue]) -> tuple[Issue, ...]:
    if len(issues) <= MOST_ISSUES:
        return tuple(issues)
    last = issues[MOST_ISSUES - 1]
    more = f"{last.message} (and {len(issues) - MOST_ISSUES} more in this file)"
    return (*issues[: MOST_ISSUES - 1], replace(last, message=more))


def _joined(prefix: str, key: str) -> str:
    """Return ``prefix.key``, or ``prefix[0]`` for the key of an entry of a list."""
    return f"{prefix}{key}" if key.startswith("[") or not (prefix and key) else f"{prefix}.{key}"


class RigidContactError(InputError):
    """Some contact direction is rigid everywhere: the force along it is undetermined."""

    def __init__(self, issues: Sequence[Issue], contact: str = "", component: str = "") -> None:
        """Name the contact and the force component ("n", "t", "o" or "m")."""
        super().__init__(issues)
        self.contact, self.component = contact, component

    def located(self, locate: Callable[[Issue], Issue]) -> RigidContactError:
        """Return the same error with each issue completed by `locate`."""
        return type(self)([locate(issue) for issue in self.issues], self.contact, self.component)


class VerdictError(InputError, AttributeError):
    """An attribute of an answer that only an answer with another verdict has; `hasattr` says no, as of any other.

    Example:
        ``hasattr(answer, "margins")`` is True of a `Plan` and False of an `Infeasible`
    """


class UnknownNameError(InputError, KeyError):
    """A name that a table does not have, which `in` and `get` may ask for."""

    __str__ = Exception.__str__  # that of KeyError puts quotes around the message


class UnknownPlaceError(InputError, IndexError):
    """A place that a sequence does not have."""


class Refusal(SynergripError):
    """A well-posed question whose answer is no, proven before any program is solved.

    Example:
        ``except Refusal as refusal: print(refusal.stage)`` of what `analyse` raises
    """

    exit_code = 1
    stage = ""


class NotRestrainedError(Refusal):
    """The contacts leave the object a motion that they do not resist, and the task loads it or asks for it."""

    stage = "restraint"

    def __init__(self, message: str, free_twists: np.ndarray, unsupported: np.ndarray) -> None:
        """Carry the free twists, shape (6, k), and the part of the load on them, shape (6,): 0 when motion asks."""
        super().__init__(message)
        self.free_twists, self.unsupported = free_twists, unsupported


class MotionCountError(Refusal):
    """More independent motions are asked for than the hand has synergies (Theorem 1, Remark 3)."""

    stage = "count"

    def __init__(self, message: str, asked: int, available: int, directions: np.ndarray) -> None:
        """Carry the number asked for, n_z, and the directions asked for, shape (6, asked)."""
        super().__init__(message)
        self.asked, self.available, self.directions = asked, available, directions


class MotionDirectionError(Refusal):
    """The wanted motion leaves Gamma_ucs, the rigid motions the synergies can produce."""

    stage = "direction"

    def __init__(self, message: str, residual: np.ndarray, time_s: float, share: float, size: float) -> None:
        """Carry the residual twist (6,), when it is largest, its share of the wish and its size in metres."""
        super().__init__(message)
        self.residual, self.time_s, self.share, self.size = residual, time_s, share, size


class InterruptError(SynergripError):
    """The user interrupted; what was finished is kept."""

    exit_code = 130


class OutputError(SynergripError):
    """What was found could not be written or printed. What was written before stands.

    Example:
        ``except OutputError as error: print(error)`` of what ``answer.save(folder)`` raises
    """

    exit_code = 5

    def __init__(self, message: str, key: str = "") -> None:
        """Say what could not be written, and the option that names it."""
        super().__init__(message)
        self.key = key


class SelfCheckError(SynergripError):
    """The program's own answer failed the program's own check: a defect of synergrip.

    Example:
        ``SelfCheckError.exit_code`` is 4
    """

    exit_code = 4


def raise_issues(issues: Sequence[Issue]) -> None:
    """Raise an `InputError` of all issues, if there are any."""
    if issues:
        raise InputError(issues)


def suggest(word: str, valid: Iterable[str]) -> str:
    """Return ``; did you mean 'x'?`` for the nearest valid word, or an empty string."""
    if len(word) > LONGEST_NAME:
        return ""  # no misspelling of anything, and slow to compare
    close = get_close_matches(str(word), [name for name in valid if len(name) <= 2 * LONGEST_NAME], n=1, cutoff=0.6)
    return f"; did you mean '{close[0]}'?" if close else ""


def one_of(word: object, valid: Iterable[str]) -> str:
    """Return the message for a word that is none of the `valid` ones."""
    names = list(valid)
    listed = ", ".join(f"'{shortened(name)}'" for name in names[: min(len(names) - 1, MOST_NAMES)])
    last = f"'{shortened(names[-1])}'" if names else "(none)"
    if len(names) > MOST_NAMES + 1:
        listed, last = f"{listed}, ...", f"{last} ({len(names)} names)"
    listed = f"{listed} or {last}" if listed else last
    told = shortened(repr(word) if isinstance(word, str) else " ".join(repr(word).split()))
    return f"{told} is not {'one of ' if len(names) > 1 else ''}{listed}{suggest(str(word), names)}"


def repeated(names: Iterable[Hashable]) -> Iterator[int]:
    """Yield the indices of names that stood before."""
    seen: set[Hashable] = set()
    for index, name in enumerate(names):
        if name in seen:
            yield index
        seen.add(name)


def kind_of(value: object) -> str:
    """Return what a value is, for messages about arguments of another type: ``str``, ``the class Grasp``."""
    return f"the class {value.__name__}" if isinstance(value, type) else type(value).__name__


def shortened(text: str, most: int = LONGEST_NAME) -> str:
    """Return a text as a message shows it: its beginning when it is very long."""
    return text if len(text) <= most else f"{text[: most - 3]}..."
