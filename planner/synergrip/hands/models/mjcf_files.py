"""The files that an MJCF model consists of, and how many elements it will have once everything is put in."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import reduce
from math import prod
from os.path import exists, realpath  # unlike Path.exists, no error for a name that is too long
from pathlib import Path

from synergrip.errors import InputError
from synergrip.hands.models.xml_elements import ALONE, DEEPEST, MOST_ELEMENTS, Element, read_xml

MOST_EXPANDED = 5000
"""Elements once every replicate and attached model is put in: MuJoCo takes a second for that many joints."""
MOST_COPIES = 500
"""That replicates and attached models make: the time that MuJoCo takes grows with their square."""
COUNTED = ("replicate", "composite")
"""Elements that stand for ``count`` times their content, or that many bodies along each of up to three axes."""


@dataclass(frozen=True)
class Amount:
    """How much MuJoCo makes of elements; bounds, not more."""

    elements: int = 0
    copies: int = 0

    def with_(self, other: Amount) -> Amount:
        """Return that of both."""
        return Amount(self.elements + other.elements, self.copies + other.copies)

    def times(self, count: int) -> Amount:
        """Return that of `count` copies."""
        return Amount(self.elements * count, max(self.copies, 1) * count)


@dataclass
class ModelFiles:
    """Reads what a model includes and attaches; all of it together is as large as one file may be."""

    left: int
    """Bytes that may still be read."""
    elements: int = 0
    _known: dict[Path, Element] = field(default_factory=dict)

    def read(self, element: Element, path: Path, kind: str) -> Element:
        """Return the outermost element of a file that `element` names; a file is read once.

        Raises:
            InputError: no such file, what `read_xml` refuses, or too many elements in all the files together.
        """
        if not exists(path):
            raise element.refused(f"the {kind} '{path}' is not there")
        known = real(path)
        if known not in self._known:
            try:
                root = read_xml(path, "MJCF file", limit=self.left)
            except InputError as error:
                issue = error.issues[0]
                raise (error if issue.line else element.refused(issue.message)) from None
            self.left -= root.length
            self.elements += root.size()
            self._known[known] = root
        if self.elements > MOST_ELEMENTS:
            raise element.refused(f"the files of this model have more than {MOST_ELEMENTS:,} elements; {ALONE}")
        return self._known[known]

    def with_includes(self, element: Element, folder: Path, opened: list[Path], depth: int = 1) -> Iterator[Element]:
        """Yield the children of `element`, with those of the included files (relative to `folder`) in their place."""
        if depth > DEEPEST:
            raise element.refused(f"elements are nested more than {DEEPEST} deep")
        for child in element.children:
            if child.tag != "include":
                yield replace(child, children=list(self.with_includes(child, folder, opened, depth + 1)))
                continue
            name = child.required("file")
            path = next((p for p in (folder / name, child.path.parent / name) if exists(p)), folder / name)
            if real(path) in opened:
                raise child.refused(f"'{name}' is included twice")
            opened.append(real(path))
            yield from self.with_includes(self.read(child, path, "included file"), folder, opened, depth + 1)


def expanded(element: Element, attached: Mapping[str, Amount], left_out: Collection[str]) -> Amount:
    """Return how much MuJoCo makes of an element.

    Args:
        element: with everything included.
        attached: the same of each attached model, by the name that <attach> calls it by.
        left_out: elements that MuJoCo does not see.

    Raises:
        InputError: more than `MOST_EXPANDED` elements or `MOST_COPIES` copies.
    """
    children = (child for child in element.children if child.tag not in left_out)
    amount = reduce(Amount.with_, (expanded(child, attached, left_out) for child in children), Amount(1))
    if element.tag in COUNTED:
        amount = amount.times(prod(_whole(text) for text in element.attributes.get("count", "").split()[:3]))
    elif element.tag == "attach":
        amount = amount.with_(attached.get(element.attributes.get("model", ""), Amount()).times(1))
    if amount.elements > MOST_EXPANDED:
        raise element.refused(f"<{element.tag}> makes more than {MOST_EXPANDED:,} elements; {ALONE}")
    if amount.copies > MOST_COPIES:
        raise element.refused(f"<{element.tag}> makes more than {MOST_COPIES} copies; {ALONE}")
    return amount


def real(path: Path) -> Path:
    """Return the path without links; unlike `Path.resolve`, links that lead in a circle are no error."""
    return Path(realpath(path))


def _whole(text: str) -> int:
    """Return a count, at least 1; what is no number MuJoCo refuses."""
    try:
        return max(int(float(text)), 1)
    except (ValueError, OverflowError):
        return 1
