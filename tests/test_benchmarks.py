"""The one command that runs all benchmarks knows all of them."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent / "benchmarks"
APART = {"all", "hostile_files", "in_grasp", "grasps_of_reach"}
"""The command itself, what kills programs on purpose, and what takes a day: in_grasp with the hands it is run on."""


def test_the_one_command_runs_every_benchmark(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(FOLDER))
    told = importlib.import_module("all").COMMANDS
    runs = {path.stem for path in FOLDER.glob("*.py") if 'if __name__ == "__main__"' in path.read_text()}
    assert set(told) == runs - APART
