"""Files that belong together change together or not at all, whatever happens and wherever they are."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from synergrip import scratch, together
from synergrip.files import atomic_path
from synergrip.signals import held_back
from synergrip.together import replace_together

NAMES = ("a.json", "b.npz", "c.csv")
SCRIPT = Path(__file__).parent / "killed_at_each_step.py"
posix = pytest.mark.skipif(os.name != "posix", reason="processes that fork")


def write(folder: Path, text: str, names: tuple[str, ...] = NAMES) -> None:
    replace_together(folder, NAMES, lambda new: [(new / name).write_text(text) for name in names])


def content(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in folder.iterdir()}


@pytest.fixture(params=["exchanged", "moved one by one"])
def there(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with an answer, on a system that exchanges folders and on one that does not."""
    if request.param == "moved one by one":
        monkeypatch.setattr(together, "_exchange", lambda *_: False)
    write(tmp_path / "there", "old")
    return tmp_path / "there"


@posix
@pytest.mark.parametrize("what", ["kill", "fail", "crowd"])
def test_killed_failing_or_in_a_crowd_there_is_one_answer(what: str) -> None:
    done = subprocess.run([sys.executable, SCRIPT, what], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.endswith("\n0 wrong\n")


def test_what_is_not_written_anew_is_gone(there: Path) -> None:
    write(there, "new", NAMES[:1])
    assert content(there) == {"a.json": "new"}
    write(there, "newer", NAMES[1:])
    assert content(there) == dict.fromkeys(NAMES[1:], "newer")
    write(there, "none", ())
    assert content(there) == {}
    assert os.listdir(there.parent) == ["there"]


def test_a_writer_that_fails_changes_nothing(there: Path) -> None:
    def half(new: Path) -> None:
        (new / "a.json").write_text("half")
        raise OSError(errno.ENOSPC, "No space left on device")

    with pytest.raises(OSError, match="No space left"):
        replace_together(there, NAMES, half)
    with pytest.raises(OSError, match="No space left"):
        replace_together(there.parent / "elsewhere", NAMES, half)
    assert content(there) == dict.fromkeys(NAMES, "old")
    assert os.listdir(there.parent) == ["there"]


@pytest.mark.parametrize("name", NAMES)
def test_a_folder_in_the_place_of_a_file_is_refused_and_nothing_is_lost(there: Path, name: str) -> None:
    (there / name).unlink()
    (there / name / "mine").mkdir(parents=True)
    for names in (NAMES, NAMES[:1], ()):
        with pytest.raises(IsADirectoryError, match=rf"'{name}' is there, and it is a folder"):
            write(there, "new", names)
    others = sorted(set(NAMES) - {name})
    assert [(there / other).read_text() for other in others] == ["old", "old"]
    assert (there / name / "mine").is_dir()


def test_what_else_is_in_the_folder_stays_as_it_is(there: Path) -> None:
    (there / "mine").mkdir()
    (there / "mine" / "note.txt").write_text("mine")
    before = there.stat().st_ino
    write(there, "new")
    assert (there / "mine" / "note.txt").read_text() == "mine"
    assert {name: (there / name).read_text() for name in NAMES} == dict.fromkeys(NAMES, "new")
    assert there.stat().st_ino == before


def test_a_file_that_comes_at_the_last_moment_is_kept(there: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    exchange = together._exchange

    def late(new: Path, folder: Path) -> bool:
        (folder / "mine.txt").write_text("mine")
        return exchange(new, folder)

    monkeypatch.setattr(together, "_exchange", late)
    write(there, "new")
    assert content(there) == {**dict.fromkeys(NAMES, "new"), "mine.txt": "mine"}


def test_who_stands_in_the_folder_goes_on_standing_there(there: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(there)
    write(Path(), "new")
    assert content(Path()) == content(there) == dict.fromkeys(NAMES, "new")


@posix
def test_another_process_that_stands_there_does_too(there: Path) -> None:
    look = "import os; print(flush=True); input(); print(sorted(os.listdir()), open('a.json').read())"
    with subprocess.Popen(
        [sys.executable, "-c", look], cwd=there, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        process.stdout.readline()
        write(there, "new")
        assert process.communicate("\n")[0] == f"{sorted(NAMES)} new\n"


@posix
def test_a_link_to_the_folder_and_the_mode_of_the_folder_stay(there: Path) -> None:
    there.chmod(0o750)
    link = there.parent / "link"
    link.symlink_to("there")
    write(link, "new")
    assert link.is_symlink()
    assert content(there) == dict.fromkeys(NAMES, "new")
    assert there.stat().st_mode & 0o777 == 0o750


@posix
def test_a_folder_alone_is_exchanged_where_the_system_can(tmp_path: Path) -> None:
    for name in "ab":
        (tmp_path / name).mkdir()
    if not together._exchange(tmp_path / "a", tmp_path / "b"):
        pytest.skip("folders are not exchanged here")
    write(tmp_path / "there", "old")
    before = (tmp_path / "there").stat().st_ino
    write(tmp_path / "there", "new")
    assert (tmp_path / "there").stat().st_ino != before


@posix
def test_new_files_have_the_mode_that_the_user_gives_files(tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        write(tmp_path / "there", "new")
        with atomic_path(tmp_path / "file") as path:
            path.touch()
    finally:
        os.umask(before)
    assert (tmp_path / "there").stat().st_mode & 0o777 == 0o750
    assert {path.stat().st_mode & 0o777 for path in (tmp_path / "there").iterdir()} == {0o640}
    assert (tmp_path / "file").stat().st_mode & 0o777 == 0o640


# One file, and the hidden folder


def test_one_file_is_replaced_whole_or_not_at_all(tmp_path: Path) -> None:
    path = tmp_path / "a" / f"{'n' * 240}.txt"  # a name as long as file systems take
    with atomic_path(path) as temporary:
        temporary.write_text("old")
    with pytest.raises(KeyboardInterrupt), atomic_path(path) as temporary:  # noqa: PT012
        temporary.write_text("half")
        raise KeyboardInterrupt
    assert content(path.parent) == {path.name: "old"}


@posix
def test_what_a_link_leads_to_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "real" / "file")
    for text in ("first", "second"):
        with atomic_path(tmp_path / "link") as temporary:
            temporary.write_text(text)
        assert (tmp_path / "link").is_symlink()
        assert content(tmp_path / "real") == {"file": text}


@posix
def test_a_device_or_a_folder_is_never_replaced(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "folder").mkdir()
    for name, kind in (("pipe", FileExistsError), ("folder", IsADirectoryError), ("link", FileExistsError)):
        if name == "link":
            (tmp_path / "link").symlink_to(os.devnull)
        with pytest.raises(kind), atomic_path(tmp_path / name):
            pass


@posix
def test_only_what_nobody_holds_any_more_is_swept(tmp_path: Path) -> None:
    dead, mine = tmp_path / f".synergrip-{'0' * 16}", tmp_path / ".synergrip-notes"
    for folder in (dead, mine):
        folder.mkdir()
        (folder / "file").touch()
    with scratch.scratch(tmp_path) as held:
        assert not dead.exists()
        scratch.sweep(tmp_path)
        assert held.is_dir()
    assert os.listdir(tmp_path) == [mine.name]


@posix
def test_another_run_that_does_not_let_go_is_named(there: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scratch, "PATIENCE_S", 0.05)
    with scratch.alone_in(there), pytest.raises(BlockingIOError, match="another run of synergrip is writing there"):
        write(there, "new")
    assert content(there) == dict.fromkeys(NAMES, "old")


@posix
def test_the_lock_is_that_of_the_folder_which_is_there_now(there: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another run puts a new folder in its place while this one waits for the lock of the old one."""
    lock = scratch._lock

    def late(folder: Path, until: float = 0.0) -> int | None:
        monkeypatch.setattr(scratch, "_lock", lock)
        handle = lock(folder, until)
        folder.rename(folder.with_name("before"))
        folder.mkdir()
        return handle

    monkeypatch.setattr(scratch, "_lock", late)
    with scratch.alone_in(there), pytest.raises(BlockingIOError):
        lock(there)


# Signals


def test_an_interrupt_waits_until_the_files_stand(there: Path) -> None:
    def interrupted(new: Path) -> None:
        signal.raise_signal(signal.SIGINT)
        for name in NAMES:
            (new / name).write_text("new")

    with pytest.raises(KeyboardInterrupt):
        replace_together(there, NAMES, interrupted)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert content(there) == dict.fromkeys(NAMES, "new")
    assert os.listdir(there.parent) == ["there"]


def test_signals_held_back_in_blocks_within_blocks_are_heard_once_at_the_end() -> None:
    done: list[str] = []
    with pytest.raises(KeyboardInterrupt):  # noqa: PT012
        with held_back():
            with held_back(signal.SIGINT):
                signal.raise_signal(signal.SIGINT)
                signal.raise_signal(signal.SIGINT)
                done.append("inner")
            done.append("outer")
        done.append("never")
    assert done == ["inner", "outer"]


def test_a_signal_that_is_ignored_stays_ignored() -> None:
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with held_back():
            signal.raise_signal(signal.SIGINT)
            assert signal.getsignal(signal.SIGINT) == signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_hidden_folder_swept_before_it_is_locked_is_made_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another run may take it for left behind between the opening and the locking of it."""
    lock, swept = scratch._lock, list[Path]()

    def late(folder: Path, until: float = 0.0) -> int | None:
        handle = lock(folder, until)
        if not swept:
            folder.rmdir()
            swept.append(folder)
        return handle

    monkeypatch.setattr(scratch, "_lock", late)
    with scratch.scratch(tmp_path) as folder:
        assert folder.is_dir()
        assert folder != swept[0]
