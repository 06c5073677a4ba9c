"""The examples in the docstrings print what they say."""

from __future__ import annotations

import doctest
from importlib import import_module
from pathlib import Path

import pytest
from names_in_examples import around

import synergrip

PACKAGE = Path(synergrip.__file__).parent
WITH_EXAMPLES = sorted(
    ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts)
    for path in (PACKAGE / "grasps").rglob("*.py")
    if ">>> " in path.read_text(encoding="utf-8")
)


@pytest.mark.parametrize("name", WITH_EXAMPLES)
def test_examples(name: str) -> None:
    assert doctest.testmod(import_module(name), extraglobs=around()).failed == 0


def test_there_are_examples() -> None:
    assert "synergrip.grasps.making" in WITH_EXAMPLES
