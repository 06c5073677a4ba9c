"""Digests of documents: files that were written with earlier versions keep theirs."""

from __future__ import annotations

import numpy as np
import pytest

from synergrip.planning.digest import digest

DOCUMENT = {
    "a": [1.0, 2.0, [3, True, None, "x"], []],
    "b": {"z": np.arange(6.0).reshape(2, 3), "y": np.array([1, 2]), "x": (0.5, 1)},
    "c": "\ud800é", "d": -0.0, "e": {"seconds": 3.0, "date": "now"}, "n": None,
}  # fmt: skip


def test_the_digest_of_a_document_stays_what_it_was() -> None:
    assert digest(DOCUMENT, list(DOCUMENT)) == "e06202174970c5792e99d1d6a8156a543bc11e3b79f0fc495156656fa3114419"


@pytest.mark.parametrize(
    "other", [{"a": [1.0, 2.0, [3, True, None], "x", []]}, {"d": 0.0}, {"n": ""}, {"b": DOCUMENT["b"] | {"x": (0.5,)}}]
)
def test_another_document_has_another_digest(other: dict[str, object]) -> None:
    assert digest(DOCUMENT | other, list(DOCUMENT)) != digest(DOCUMENT, list(DOCUMENT))


def test_how_long_something_took_counts_for_nothing() -> None:
    assert digest({"e": {"seconds": 4.0, "date": "now"}}, ["e"]) == digest({"e": DOCUMENT["e"]}, ["e"])
