"""Texts of XML files with one thing broken."""

from __future__ import annotations

import re

import numpy as np

NUMBER = re.compile(r"(?<=[\"\s])-?\d+\.?\d*(e-?\d+)?(?=[\"\s])")
ATTRIBUTE = re.compile(r"\s[\w:]+=\"[^\"]*\"")
ELEMENT = re.compile(r"<\w[^<>]*/>")
STRANGE = ["nan", "inf", "-inf", "1e300", "-1e9", "0", "", "one", "1 2", "&amp;", "&", "<", "é", "-1"]


def damaged(text: str, rng: np.random.Generator) -> str:
    """Return the text with an attribute, an element or a number deleted, repeated, replaced or moved, or cut short."""
    way = rng.integers(7)
    if way == 0:
        return text[: rng.integers(len(text))]
    pattern = (NUMBER, ATTRIBUTE, ELEMENT)[way % 3]
    places = list(pattern.finditer(text))
    first, second = (places[i] for i in sorted(rng.choice(len(places), 2, replace=False)))
    if way in (1, 2):
        return text[: first.start()] + text[first.end() :]
    if way == 3:
        return text[: first.start()] + str(rng.choice(STRANGE)) + text[first.end() :]
    if way == 4:
        return text[: first.start()] + re.sub('"[^"]*"', f'"{rng.choice(STRANGE)}"', first[0]) + text[first.end() :]
    if way == 5:
        return text[: first.end()] + first[0] + text[first.end() :]
    between = text[first.end() : second.start()]
    return text[: first.start()] + second[0] + between + first[0] + text[second.end() :]
