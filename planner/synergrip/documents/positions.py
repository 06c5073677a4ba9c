"""Where each key and value of a TOML or JSON text stands, for messages that point at it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

import tree_sitter_json
import tree_sitter_toml
from tree_sitter import Language, Node, Parser

KeyPath = tuple[str | int, ...]

_SPECIAL = re.compile(r'"(?:\\.|[^"\\])*"|-?Infinity|NaN')
_GRAMMARS = {".toml": tree_sitter_toml.language, ".json": tree_sitter_json.language}


@dataclass(frozen=True)
class Span:
    """A piece of one line: 1-based line and column, in characters."""

    line: int
    column: int
    length: int


@dataclass(frozen=True)
class Place:
    """Where a value and its key stand; an item of a list has no key."""

    value: Span
    key: Span | None = None


@dataclass
class Positions:
    """Places by dotted key (``contact[1].model``), and the keys written twice."""

    places: dict[str, Place] = field(default_factory=dict)
    duplicates: list[tuple[str, Place, Place]] = field(default_factory=list)
    """(key, first place, second place)"""
    implied: set[str] = field(default_factory=set)
    """Tables that so far are known only from the names of what is inside."""

    def add(self, path: KeyPath, place: Place) -> None:
        """Record where `path` stands, or that it stands there once more."""
        key = dotted(path)
        if key in self.places and key not in self.implied:
            self.duplicates.append((key, self.places[key], place))
        else:
            self.places[key] = place
            self.implied.discard(key)

    def imply(self, path: KeyPath, span: Span) -> None:
        """Record that the name at `span` speaks of the table or list at `path`."""
        key = dotted(path)
        if key not in self.places:
            self.places[key] = Place(span, span)
            self.implied.add(key)

    def nearest(self, key: str) -> tuple[str, Place] | None:
        """Return the place of `key`, or that of the innermost table or list around it."""
        while key and key not in self.places:
            key = enclosing(key)
        return (key, self.places[key]) if key else None


def dotted(path: KeyPath) -> str:
    """Return ``contact[1].model`` for ``("contact", 1, "model")``."""
    text = ""
    for part in path:
        text += f"[{part}]" if isinstance(part, int) else f".{part}" if text else part
    return text


def enclosing(key: str) -> str:
    """Return the key of the table or list that holds `key`; empty at the top."""
    return key[: max(key.rfind("."), key.rfind("["), 0)]


def positions(text: str, suffix: str) -> Positions:
    """Return where everything stands in `text`, whose grammar goes by `suffix` (``.toml`` or ``.json``)."""
    if suffix == ".json":  # NaN and Infinity would derail the parser: put numbers of the same length in their place
        text = _SPECIAL.sub(lambda m: m[0] if m[0][0] == '"' else re.sub(r"\w", "1", m[0]), text)
    source = text.encode()
    root = Parser(Language(_GRAMMARS[suffix]())).parse(source).root_node
    walk = _Walk(source.split(b"\n"), Positions())
    if suffix == ".json":
        for node in root.named_children:
            walk.value(node, ())
    else:
        walk.toml(root)
    return walk.found


@dataclass
class _Walk:
    lines: list[bytes]
    found: Positions
    reached: tuple[int, int, int] = (0, 0, 0)
    """Row, bytes and characters up to the last place: lines may be long, and places come mostly in order."""

    def span(self, node: Node) -> Span:
        (row, start), (last, end) = node.start_point, node.end_point
        line = self.lines[row]
        stop = end if last == row else len(line)
        last_row, last_byte, characters = self.reached
        if row != last_row or start < last_byte:
            last_byte, characters = 0, 0
        characters += len(line[last_byte:start].decode())
        self.reached = row, start, characters
        return Span(row + 1, characters + 1, max(len(line[start:stop].decode()), 1))

    def toml(self, root: Node) -> None:
        counts: dict[str, int] = {}
        for node in root.named_children:
            if node.type == "pair":
                self.pair(node, ())
            elif node.type in ("table", "table_array_element"):
                self.table(node, counts)

    def table(self, node: Node, counts: dict[str, int]) -> None:
        head = _without_comments(node)[0]
        span = self.span(head)
        path: KeyPath = ()
        names = list(_names(head))
        for name in names[:-1]:
            path = (*path, name)
            self.found.imply(path, span)
            if dotted(path) in counts:
                path = (*path, counts[dotted(path)] - 1)
        path = (*path, names[-1])
        if node.type == "table_array_element":
            self.found.imply(path, span)
            index = counts.get(dotted(path), 0)
            counts[dotted(path)] = index + 1
            path = (*path, index)
        self.found.add(path, Place(span, span))
        for child in node.named_children[1:]:
            if child.type == "pair":
                self.pair(child, path)

    def pair(self, node: Node, path: KeyPath) -> None:
        key, *values = _without_comments(node)
        names = list(_names(key))
        span = self.span(key)
        for name in names[:-1]:
            path = (*path, name)
            self.found.imply(path, span)
        self.value(values[0] if values else key, (*path, names[-1]), span)

    def value(self, node: Node, path: KeyPath, key: Span | None = None) -> None:
        if path:
            self.found.add(path, Place(self.span(node), key))
        children = _without_comments(node)
        if node.type == "array":
            for index, child in enumerate(children):
                self.value(child, (*path, index))
        elif node.type in ("inline_table", "object"):
            for child in children:
                if child.type == "pair":
                    self.pair(child, path)


def _without_comments(node: Node) -> list[Node]:
    """Return the named children that are keys and values; a comment may stand anywhere between them."""
    return [child for child in node.named_children if child.type not in ("comment", "ERROR")]


def _names(node: Node) -> Iterator[str]:
    """Yield the parts of a key; a quoted part comes without its quotes."""
    if node.type == "dotted_key":
        for child in node.named_children:
            yield from _names(child)
        return
    text = (node.text or b"").decode()
    yield text[1:-1] if text[:1] in ('"', "'") else text
