"""What a problem file may say of a limit: the key under [limits], how its value is read, and what it becomes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any, Literal

from synergrip.conic.limits.limit import Limit
from synergrip.documents.fields import (
    POSITIVE,
    Schema,
    Written,
    array_of,
    either,
    listed,
    unit_schema,
)
from synergrip.documents.numbers import number
from synergrip.errors import InputError, raise_issues
from synergrip.hands.units import joint_kinds, list_misfits, synergy_kinds

if TYPE_CHECKING:
    from synergrip.grasps.grasp import Grasp


@dataclass(frozen=True)
class FileKey:
    """A key under [limits]."""

    name: str
    kind: type[Limit]
    """Class of the limit."""
    type: Any
    """Annotation of the value: how it is read, and its JSON Schema."""
    description: str
    make: Callable[[Any, Grasp], Limit] | None = None
    """The limit of a value that was read, for a grasp, where it is not simply ``kind(value)``."""
    default: str | None = None
    """The value where none stands; None for no limit."""
    efforts_of: Literal["joint", "synergy"] | None = None
    """Whose efforts the value holds, whose units are to suit what turns and what slides; None when it holds none."""

    @property
    def key(self) -> str:
        """The key with its table."""
        return f"limits.{self.name}"


def _one_each(read: Callable[[Any], float], word: str = "") -> Callable[[Any], Any]:
    """Return the function that reads one bound for all, a list of them, or the `word`."""

    def bounds(value: object) -> float | str | tuple[float, ...]:
        if isinstance(value, list):
            return listed(read, value)
        if word and value == word:
            return word
        if word and isinstance(value, str) and value.strip().isalpha():
            raise InputError.at(
                "", f"expected '{word}', a number, a torque such as \"1.5 N m\" or a list, got {value!r}"
            )
        return read(value)

    return bounds


def _one_each_schema(one: list[Schema], word: str = "") -> Schema:
    words: list[Schema] = [{"const": word}] if word else []
    return {"anyOf": [*words, *one, array_of({"anyOf": one})]}


_written_effort = either("torque", "force", above=0)


def _effort(value: object) -> float:
    return _written_effort(value) if isinstance(value, str) else number(value, above=0)


def _positive(value: object) -> float:
    return number(value, above=0)


Efforts = Annotated[
    float | tuple[float, ...] | Literal["hand"],
    Written(_one_each(_effort, "hand"), _one_each_schema([POSITIVE, unit_schema("torque", "force")], "hand")),
]
"""Efforts of joints or synergies: one, one for each, or those that the hand states."""
OwnEfforts = Annotated[
    float | tuple[float, ...],
    Written(_one_each(_effort), _one_each_schema([POSITIVE, unit_schema("torque", "force")])),
]
"""Efforts of joints or synergies that no hand states: one, or one for each."""
References = Annotated[float | tuple[float, ...], Written(_one_each(_positive), _one_each_schema([POSITIVE]))]
"""Sizes of synergies, in their own units: one, or one for each."""


def or_of_hand(kind: Callable[[Any], Limit]) -> Callable[[Any, Grasp], Limit]:
    """Return how a limit is made of a value that may be ``"hand"``, which a grasp given as matrices does not have."""

    def made(value: Any, grasp: Grasp) -> Limit:
        if value == "hand" and grasp.held is None:
            raise InputError.at("", "'hand' needs a [hand]; a grasp file states no limits, write numbers")
        return kind(value)

    return made


def limit_of(key: FileKey, value: Any, grasp: Grasp) -> Limit:
    """Return the limit that a value under a key stands for.

    Raises:
        InputError: what the limit refuses, and values in units of joints that turn for those that slide, or the
            reverse; at the key.
    """
    try:
        made = (key.kind(value) if key.make is None else key.make(value, grasp)).on(grasp)
    except InputError as error:  # of an argument of the limit; its place is the key
        raise InputError([replace(issue, key=key.key) for issue in error.issues]) from None
    if key.efforts_of is not None and grasp.held is not None and not isinstance(value, str):
        kinds = joint_kinds(grasp.held.hand.joints)
        if key.efforts_of == "synergy":
            kinds = synergy_kinds(grasp.held.synergies, kinds.values())
        raise_issues(list_misfits(key.key, value, kinds, key.efforts_of))
    return made
