"""An XML file as elements that know their line; what only machines need (types, entities) is refused."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

from synergrip.documents import read_text
from synergrip.errors import InputError, Issue

DEEPEST = 200
"""Elements inside each other."""

_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)


@dataclass
class Element:
    """An element of an XML file."""

    tag: str
    attributes: dict[str, str]
    path: Path
    line: int  # 1-based
    children: list[Element] = field(default_factory=list)

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


def read_xml(path: Path, kind: str, key: str = "") -> Element:
    """Return the outermost element of the XML file at `path`.

    Args:
        path: the file.
        kind: what it is to the user, for messages.
        key: the key of another file that names this one, for a file that is missing.

    Raises:
        InputError: no such file, not XML, a document type or an entity in it, elements nested too deeply; with
            file and line.
    """
    # The readers of robot files, unlike XML, allow "--" in a comment.
    text = _COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), read_text(path, kind, key))
    parser = expat.ParserCreate(encoding="UTF-8")
    top = Element("", {}, path, 1)
    stack = [top]

    def refuse(message: str) -> InputError:
        return InputError([Issue(message, file=str(path), line=parser.CurrentLineNumber, column=1)])

    def start(tag: str, attributes: dict[str, str]) -> None:
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
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        issue = Issue(f"not XML: {expat.ErrorString(error.code)}", file=str(path), line=error.lineno)
        raise InputError([issue]) from None
    return top.children[0]
