"""Where a line may break: between words, but not within a number, between it and its unit, or within a command."""

from __future__ import annotations

import re
import unicodedata

from synergrip.documents.quantities import UNITS

TIED = "\u00a0"
"""A space at which no line breaks."""
_UNITS = "|".join(
    sorted((re.escape(unit) for units in UNITS.values() for unit in units), key=len, reverse=True)
).replace(r"\ ", "[ \u00a0]")
_ESCAPE = re.compile(r"\x1b\[[\d;]*m")
_NUMBER = r"[-+]?\d[\d.]*(?:e[-+]?\d+)?"
_TIES = (
    re.compile(rf"(?<=\d) (?=(?:{_UNITS}|%)(?![\w/]))"),  # 10 mm
    re.compile(r"(?<=\d\u00a0N) (?=mm?(?![\w/]))|(?<=\d\u00a0mN) (?=m(?![\w/]))"),  # 10 N m
    re.compile(r" (?=[·✓])"),
    re.compile(rf"(?<=\S) (?=[=≥≤<>] {_NUMBER})|(?<= [=≥≤<>]) (?={_NUMBER})"),  # t = 0.5
    re.compile(rf"(?<=[ (\u00a0][-+]) (?={_NUMBER})|(?<=^[-+]) (?={_NUMBER})"),  # - 0.5
)
_TRIPLE = re.compile(rf"\({_NUMBER}(?:, {_NUMBER})+\)(?: (?:mm|deg)(?!\w))?")
_COMMAND = re.compile(r"--set (?:'[^']*'|\S+)")


def glued(text: str) -> str:
    """Return text with tied spaces where no line may break."""
    text = _COMMAND.sub(lambda found: found[0].replace(" ", TIED), text)
    text = _TRIPLE.sub(lambda found: found[0].replace(" ", TIED), text)
    for tie in _TIES:
        text = tie.sub(TIED, text)
    return text


def freed(text: str) -> str:
    """Return text with all spaces as they are written."""
    return text.replace(TIED, " ")


def cells(text: str) -> int:
    """Return how many columns of a terminal text takes."""
    if text.isascii():
        return len(text) if "\x1b" not in text else len(_ESCAPE.sub("", text))
    text = _ESCAPE.sub("", text)
    wide = sum(unicodedata.east_asian_width(letter) in "WF" for letter in text)
    return len(text) + wide - sum(unicodedata.combining(letter) != 0 for letter in text)


def parted(text: str, width: int) -> list[str]:
    """Return text in lines of at most `width` columns; a word that is longer has its own line, and is not split.

    What is tied and longer than a line breaks at its spaces after all: a command with a list, after a comma.
    """
    if cells(text) <= width:
        return [text]
    lines = list[str]()
    for word in (part for each in text.split(" ") if each for part in _loosened(each, width)):
        if lines and cells(lines[-1]) + 1 + cells(word) <= width:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines or [""]


def _loosened(word: str, width: int) -> list[str]:
    """Return a word that fits as it is; of a tied one that does not fit the parts that commas end, or its words."""
    if cells(word) <= width or TIED not in word:
        return [word]
    parts = re.split(rf"(?<=,){TIED}", word)
    return parts if len(parts) > 1 else word.split(TIED)
