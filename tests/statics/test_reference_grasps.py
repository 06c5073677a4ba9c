"""Agreement with another program: seven grasps of SynGrasp 2.2 (see tests/data/syngrasp/README.md)."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from synergrip.grasps.given import given
from synergrip.grasps.matrices import read_matrices
from synergrip.statics import coordinates, respond, subspaces

FILES = sorted((Path(__file__).parent.parent / "data" / "syngrasp").glob("*.json"))


def test_all_seven_are_here() -> None:
    assert len(FILES) == 7


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_maps_agree(path: Path) -> None:
    expected = json.loads(path.read_text())["expect"]
    response = respond(given(read_matrices(path)))
    for name in ("dlambda_dzr", "du_dzr", "dq_dzr", "dtau_dzr"):
        theirs = np.array(expected[name])
        assert np.abs(getattr(response, name) - theirs).max() < 1e-8 * np.abs(theirs).max(), name


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_dimensions_agree(path: Path) -> None:
    expected = json.loads(path.read_text())["expect"]
    response = respond(given(read_matrices(path)))
    spaces = subspaces(response)
    assert spaces.dimensions == tuple(expected[f"dim_{name}"] for name in ("E_s", "Gamma_ucs", "Gamma_zr"))
    assert not spaces.ambiguous
    assert np.isfinite(coordinates(response, spaces).condition)
