"""``KEY=VALUE`` texts that change single values of a document, as in ``--set limits.margin="0.3 N"``."""

from __future__ import annotations

import copy
import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from synergrip.documents.positions import KeyPath, dotted, enclosing
from synergrip.documents.syntax import LONGEST_KEY, check_keys
from synergrip.errors import InputError, Issue, raise_issues

_PART = re.compile(r"""(?:"([^"]+)"|'([^']+)'|([^.\[\]"'\s=]+))((?:\[\d{1,9}\])*)(\.(?=.)|\Z)""")
_BARE = re.compile(r"""[^.\[\]"'\s=]+""")


@dataclass(frozen=True)
class Override:
    """A value to put in place of another."""

    text: str
    """As the user wrote it."""
    path: KeyPath
    value: Any

    @property
    def key(self) -> str:
        """The dotted key."""
        return dotted(self.path)

    def shares(self, key: str) -> str:
        """Return the key of the innermost table, list or value that this override and `key` have in common."""
        while key and key != self.key and not self.key.startswith((f"{key}.", f"{key}[")):
            key = self.key if key.startswith((f"{self.key}.", f"{self.key}[")) else enclosing(key)
        return key


def parse_override(text: str) -> Override:
    """Return the key and the value of ``KEY=VALUE``.

    The key is dotted, with list indices (``contact[1].friction``) and quotes around parts that hold dots.
    The value is read as TOML (``21``, ``true``, ``["0 N", "20 N"]``); what is not TOML is a string (``0.3 N``).

    Raises:
        InputError: no ``=`` or no such key can exist.
    """
    key, equals, value = _split(text)
    if not equals:
        raise _refuse(text, "expected KEY=VALUE, for example limits.margin=0.3 N")
    path: list[str | int] = []
    position = 0
    while position < len(key) or not path:
        part = _PART.match(key, position)
        if part is None:
            raise _refuse(text, f"{key!r} is not a key such as task.knots or contact[1].friction")
        path.append(part[1] or part[2] or part[3])
        path.extend(int(index) for index in re.findall(r"\d+", part[4]))
        position = part.end()
    if len(path) > LONGEST_KEY:
        raise _refuse(text, f"a key has at most {LONGEST_KEY} parts, got {len(path)}")
    return Override(text, tuple(path), _value(value.strip()))


def apply_overrides(data: dict[str, Any], texts: Sequence[str]) -> tuple[dict[str, Any], tuple[Override, ...]]:
    """Return a copy of `data` with every override put in, and the overrides.

    Raises:
        InputError: all the texts that cannot be applied.
    """
    changed = copy.deepcopy(data)
    applied: list[Override] = []
    issues: list[Issue] = []
    for text in texts:
        try:
            override = parse_override(text)
            _put(changed, override)
        except InputError as error:
            issues += error.issues
        else:
            applied.append(override)
    raise_issues(issues)
    return changed, tuple(applied)


def _split(text: str) -> tuple[str, str, str]:
    match = re.match(r"""((?:"[^"]*"|'[^']*'|[^="'])*)(=)(.*)\Z""", text, re.DOTALL)
    return (match[1].strip(), match[2], match[3]) if match else (text, "", "")


def _value(text: str) -> Any:
    try:
        check_keys(text)
        table = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        return text
    return table["value"] if len(table) == 1 else text


def _put(data: dict[str, Any], override: Override) -> None:
    holder: Any = data
    for depth, part in enumerate(override.path):
        here = dotted(override.path[:depth])
        if isinstance(part, int):
            _check_index(holder, part, here, override)
        elif isinstance(holder, list):
            raise _refuse(override.text, _list_advice(holder, here, override.path[depth:]), override.key)
        elif not isinstance(holder, dict):
            raise _refuse(override.text, f"'{here}' is a value and not a table", override.key)
        if depth == len(override.path) - 1:
            holder[part] = copy.deepcopy(override.value)
        else:
            if isinstance(holder, dict) and part not in holder:
                holder[part] = {}
            holder = holder[part]


def _list_advice(entries: list[Any], here: str, rest: KeyPath) -> str:
    """Return what to write instead of a name that follows a list: a key of an entry that is there."""
    if not entries:
        return f"'{here}' is an empty list; give the whole list, {here}=[...]"
    number = _number(rest[0])
    if number is not None and number >= len(entries):
        return f"'{here}' has {_counted(entries)}; there is no [{number}]"
    return f"'{here}' is a list; write {here}{_written(_meant(entries, rest))}"


def _meant(holder: object, path: KeyPath) -> KeyPath:
    """Return the path with an index for each list that it leads through, up to the first value."""
    if not path or not isinstance(holder, dict | list):
        return ()
    first, rest = path[0], path[1:]
    if isinstance(holder, dict):
        return (first, *(_meant(holder[first], rest) if first in holder else rest))
    number = _number(first)
    if number is None:  # a name: that of something in an entry, if possible in one that has it
        rest = path
        number = next((i for i, entry in enumerate(holder) if isinstance(entry, dict) and first in entry), 0)
    return (number, *_meant(holder[min(number, len(holder) - 1)], rest)) if holder else ()


def _number(part: str | int) -> int | None:
    """Return the index that a part of a key is or looks like."""
    return int(part) if isinstance(part, int) or (part.isascii() and part.isdecimal() and len(part) < 10) else None


def _written(path: KeyPath) -> str:
    """Return a path as it is typed after a key, with quotes around parts that need them."""
    texts = (f'"{part}"' if isinstance(part, str) and not _BARE.fullmatch(part) else part for part in path)
    return "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in texts)


def _counted(entries: list[Any]) -> str:
    return f"{len(entries)} entr{'y' if len(entries) == 1 else 'ies'}, counted from 0"


def _check_index(holder: object, index: int, here: str, override: Override) -> None:
    if not isinstance(holder, list):
        missing = "there is no list '{0}'; give the whole list, {0}=[...]" if holder == {} else "'{0}' is not a list"
        raise _refuse(override.text, missing.format(here), override.key)
    if index >= len(holder):
        raise _refuse(override.text, f"'{here}' has {_counted(holder)}; there is no [{index}]", override.key)


def _refuse(text: str, message: str, key: str = "") -> InputError:
    return InputError([Issue(message, key=key, file=f"--set {text}")])
