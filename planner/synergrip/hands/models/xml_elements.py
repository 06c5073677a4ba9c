"""An XML file as elements that know their line; what only machines need (types, entities) is refused."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from xml.parsers import expat

from synergrip.errors import InputError, Issue
from synergrip.plain_file import read_text

DEEPEST = 200
"""Elements inside each other."""

_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)

LARGEST_MODEL = 16_000_000
"""Bytes of a model together with what it includes; it has its meshes in files of their own."""
MOST_ELEMENTS = 50_000
"""A humanoid with two hands has some thousand."""
MOST_ATTRIBUTES = 500_000
ALONE = "give the hand alone"
LONGEST_TEXT = 10_000
"""Characters of an attribute that bears on how a hand moves."""


@dataclass
class Element:
    """An element of an XML file."""

    tag: str
    attributes: dict[str, str]
    path: Path
    line: int  # 1-based
    children: list[Element] = field(default_factory=list)
    length: int = 0
    """Of the outermost element: bytes of the file."""

    @property
    def place(self) -> str:
        """File and line, for messages."""
        return f"{self.path}:{self.line}"

    def all(self, tag: str) -> Iterator[Element]:
        """Yield the children of that tag."""
        return (child for child in self.children if child.tag == tag)

    def child(self, tag: str) -> Element:
        """Return the first child of that tag, or an empty one that stands for the defaults."""
        return next(self.all(tag), Element(tag, {}, self.path, self.line))

    def refused(self, message: str) -> InputError:
        """Return the error that stands at this element."""
        return InputError([Issue(message, file=str(self.path), line=self.line, column=1)])

    def required(self, attribute: str) -> str:
        """Return the text of an attribute that must be there, or raise an `InputError`."""
        value = self.attributes.get(attribute, "")
        if not value:
            raise self.refused(f"<{self.tag}> needs the attribute '{attribute}'")
        return value

    def check_length(self, attribute: str) -> None:
        """Refuse an attribute that is longer than anything that bears on how a hand moves."""
        length = len(self.attributes.get(attribute, ""))
        if length > LONGEST_TEXT:
            raise self.refused(
                f"<{self.tag} {attribute}> has {length:,} characters; expected a name or a few numbers, in at most "
                f"{LONGEST_TEXT:,} characters"
            )

    def size(self) -> int:
        """Return the number of elements from here on downward."""
        return 1 + sum(child.size() for child in self.children)


def read_xml(path: Path, kind: str, key: str = "", limit: int = LARGEST_MODEL) -> Element:
    """Return the outermost element of the XML file at `path`.

    Args:
        path: the file.
        kind: what it is to the user, for messages.
        key: the key of another file that names this one, for a file that is missing.
        limit: bytes that may be read.

    Raises:
        InputError: no such file, not XML, too much of it, a document type or an entity in it, elements nested too
            deeply; with file and line.
    """
    text = _without_comments(path, read_text(path, kind, key, limit))
    if text.count("=") > MOST_ATTRIBUTES:
        raise InputError([Issue(f"the file has more than {MOST_ATTRIBUTES:,} attributes; {ALONE}", file=str(path))])
    parser = expat.ParserCreate(encoding="UTF-8")
    top = Element("", {}, path, 1)
    stack = [top]
    count = 0

    def refuse(message: str) -> InputError:
        return InputError([Issue(message, file=str(path), line=parser.CurrentLineNumber, column=1)])

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal count
        count += 1
        if count > MOST_ELEMENTS:
            raise refuse(f"the file has more than {MOST_ELEMENTS:,} elements; {ALONE}")
        if len(stack) > DEEPEST:
            raise refuse(f"elements are nested more than {DEEPEST} deep")
        element = Element(tag, attributes, path, parser.CurrentLineNumber)
        stack[-1].children.append(element)
        stack.append(element)

    def declared(*_: object) -> None:
        raise refuse("a document type or entity declaration (<!DOCTYPE ...>) is not allowed; remove it")

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda _: stack.pop()
    parser.StartDoctypeDeclHandler = declared
    parser.EntityDeclHandler = declared
    raw = text.encode()
    try:
        parser.Parse(raw, True)
    except expat.ExpatError as error:
        issue = Issue(f"not XML: {expat.ErrorString(error.code)}", file=str(path), line=error.lineno)
        raise InputError([issue]) from None
    return replace(top.children[0], length=len(raw))


def _without_comments(path: Path, text: str) -> str:
    """Return the text without comments, in which the readers of robot files, unlike XML, allow "--"."""
    end = text.rfind("-->") + len("-->") if "-->" in text else 0  # beyond it, the pattern would look in vain every time
    whole = _COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), text[:end]) + text[end:]
    start = whole.find("<!--")
    if start >= 0:
        line = whole.count("\n", 0, start) + 1
        raise InputError([Issue("this comment has no end; close it with -->", file=str(path), line=line, column=1)])
    return whole
