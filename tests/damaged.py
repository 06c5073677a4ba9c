"""Texts of XML files with one thing broken, and what becomes of hands that are read from them."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np

from synergrip.errors import InputError, Issue
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import Hand

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


def refusals(text: str, seed: int, times: int, look: Callable[[Hand], None]) -> list[Issue]:
    """Return what is refused of damaged copies of a text, each read as ``hand.xml`` in the current folder.

    `look` is given every hand that loads. Each refusal has a place, and nothing else is left in the folder.
    """
    rng, issues = np.random.default_rng(seed), list[Issue]()
    for _ in range(times):
        Path("hand.xml").write_text(damaged(text, rng), encoding="utf-8")
        try:
            hand = load_hand("hand.xml")
        except InputError as error:
            issues += error.issues
        else:
            look(hand)
    assert all(issue.file or issue.key for issue in issues)
    assert [entry.name for entry in Path().iterdir()] == ["hand.xml"]  # and no log file of MuJoCo
    return issues
