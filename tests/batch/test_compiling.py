"""What is kept compiled on the disk is never that of sources that have changed since."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import synergrip.batch
from synergrip.batch import fast_kernel, fast_statics

FOLDER = Path(synergrip.batch.__file__).parent


def made_of(name: str) -> set[str]:
    """The files of lanes that a file imports, with those that these import; of others they take constants alone."""
    found, waiting = set(), [name]
    while waiting:
        here = waiting.pop()
        found.add(here)
        for node in ast.walk(ast.parse((FOLDER / here).read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("synergrip.batch."):
                other = node.module.rpartition(".")[2] + ".py"
                if other.startswith("lanes") and other not in found:
                    waiting.append(other)
    return found


def test_the_stamp_of_what_is_kept_is_of_all_its_sources() -> None:
    assert made_of("lanes_kernel.py") <= set(fast_kernel.SOURCES)
    assert made_of("lanes_statics.py") <= set(fast_statics.SOURCES)


def test_parts_are_not_kept_by_themselves() -> None:
    # Numba looks at the file of a part alone: one that another file has changed under would be used as it was.
    pytest.importorskip("numba")
    from synergrip.batch.lanes_dense import cholesky, reflected
    from synergrip.batch.lanes_linear import factor

    assert [part.stats.cache_path for part in (cholesky, reflected, factor)] == [None] * 3
