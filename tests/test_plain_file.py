import os

import pytest

from synergrip import plain_file
from synergrip.errors import InputError
from synergrip.plain_file import LARGEST_FILE, read_bytes, read_text


def refusal(path, **arguments):
    with pytest.raises(InputError) as caught:
        read_bytes(path, "CSV file", **arguments)
    (issue,) = caught.value.issues
    return issue


def test_a_file_is_read_to_its_last_byte(tmp_path):
    for size in (0, 1, 3_000_000):
        (tmp_path / "a").write_bytes(b"x" * size)
        assert read_bytes(tmp_path / "a", limit=3_000_000) == b"x" * size


def test_a_file_larger_than_the_limit_is_not_read_at_all(tmp_path, monkeypatch):
    (tmp_path / "a").write_bytes(b"")
    os.truncate(tmp_path / "a", LARGEST_FILE + 1)
    monkeypatch.setattr(plain_file.os, "read", lambda *_: pytest.fail("read"))
    issue = refusal(tmp_path / "a")
    assert issue.message == f"'{tmp_path / 'a'}' is larger than 32 MB, the most that is read here; is it a CSV file?"


def test_a_file_that_grows_or_claims_size_0_is_read_to_the_limit_only(tmp_path, monkeypatch):
    (tmp_path / "a").write_bytes(b"")
    total = 0

    def endless(_, size):
        nonlocal total
        total += size
        return b"x" * size

    monkeypatch.setattr(plain_file.os, "read", endless)
    assert "is larger than 5 MB" in refusal(tmp_path / "a", limit=5_000_000).message
    assert total == 5_000_001


@pytest.mark.skipif(not os.path.exists("/proc/self/maps"), reason="no such files on this system")
def test_files_of_the_system_that_claim_size_0_are_read():
    assert "python" in read_text(plain_file.Path("/proc/self/maps"))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes in folders here")
def test_a_pipe_that_takes_the_place_of_a_file_is_refused_too(tmp_path, monkeypatch):
    (tmp_path / "a").write_text("x")
    plain = os.stat(tmp_path / "a")
    os.mkfifo(tmp_path / "pipe")
    monkeypatch.setattr(plain_file.os, "stat", lambda _: plain)  # what was looked at before it was opened
    assert "is a pipe; expected a CSV file" in refusal(tmp_path / "pipe").message


def test_the_key_that_names_a_file_keeps_the_issue_without_a_place(tmp_path):
    issue = refusal(tmp_path / "b.csv", key="task.wrench")
    assert (issue.key, issue.file) == ("task.wrench", "")
    assert refusal(tmp_path / "b.csv").file == str(tmp_path / "b.csv")
    (tmp_path / "c.csv").write_text("")
    assert "did you mean 'c.csv'?" in refusal(tmp_path / "b.csv").message
