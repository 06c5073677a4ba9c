"""Nothing that a file may hold hangs a command, exhausts the memory or crashes it: exit 2, with words.

What it costs is measured by `benchmarks/hostile_files.py`; here a command may take as long as it likes up to a limit
that no honest machine needs, and may read no more bytes than are allowed.
"""

import os
import signal

import hostile_models
import pytest
from command_line import run
from hostile_files import CASES, GRASP, HAND, MATRICES, PLAN, WRENCH, text

from synergrip import plain_file

assert hostile_models.CASES is CASES
PATIENCE = 120
"""[s] It is an endless loop that is to be noticed, not a slow machine."""
MOST_READ = 2 * plain_file.LARGEST_FILE
"""Bytes: a file, and what it names."""

pytestmark = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes and devices have other names here")


@pytest.fixture
def reading(monkeypatch):
    """Count the bytes that are read, and stop the test when time or bytes run out."""
    read, count = os.read, [0]

    def counted(descriptor, size):
        chunk = read(descriptor, size)
        count[0] += len(chunk)
        assert count[0] <= MOST_READ, "more is read than any input needs"
        return chunk

    def late(*_):
        raise TimeoutError("the command does not come to an end")

    monkeypatch.setattr(plain_file.os, "read", counted)
    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(PATIENCE)
    yield count
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


def command(case, folder):
    return [part.replace("@", str(folder)) for part in case.command]


def test_there_are_many_cases_with_names_of_their_own():
    names = [case.name for case in CASES]
    assert len(names) == len(set(names)) >= 200


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_hostile_file_is_refused(case, tmp_path, reading):
    case.lay(tmp_path)
    result = run(*command(case, tmp_path))
    assert result.exit_code == 2, result.output
    assert "nothing was solved" in result.output
    assert case.fragment in result.output
    assert case.file in result.output
    assert len(result.output) < 20_000, "nobody reads that much"


def test_what_the_cases_start_from_is_no_bad_input(tmp_path):
    text("problem.toml", lambda: HAND)(tmp_path)
    assert run(*[part.replace("@", str(tmp_path)) for part in PLAN]).exit_code in (0, 1)
    text("problem.toml", lambda: MATRICES, grasp_json=GRASP, wrench_csv=WRENCH)(tmp_path)
    assert run(*[part.replace("@", str(tmp_path)) for part in PLAN]).exit_code in (0, 1)
