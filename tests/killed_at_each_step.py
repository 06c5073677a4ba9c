"""Writers of files that belong together, killed or failing at each step that they ask of the system.

    python tests/killed_at_each_step.py kill | fail | crowd

prints one line for each way of writing, and what was wrong. It imports no numerical library, so that it can fork.
"""

from __future__ import annotations

import itertools
import os
import signal
import sys
import tempfile
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

from synergrip.scratch import NAME, alone_in
from synergrip.together import replace_together

NAMES = ("a.json", "b.npz", "c.csv")
CHANGES = {"os.rename", "os.remove", "os.rmdir", "os.mkdir", "os.chmod", "open", "ctypes.dlsym"}
WAYS = {  # who else is in the folder, what was there, what comes
    "whole": ((), NAMES, NAMES),
    "fewer": ((), NAMES, NAMES[:1]),
    "more": ((), NAMES[1:], NAMES),
    "new": ((), (), NAMES),
    "none": ((), NAMES, ()),
    "beside": (("mine.txt",), NAMES, NAMES),
    "beside, fewer": (("mine.txt",), NAMES, NAMES[:1]),
    "beside, others": (("mine.txt",), NAMES[:1], NAMES[1:]),
    "beside, new": (("mine.txt",), (), NAMES),
}
MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
"""Where files are in memory: the order of the steps is tried here, not the disk."""
at_step: list[Callable[[], None]] = []


def hook(event: str, arguments: tuple[Any, ...]) -> None:
    """Call who waits for a step of the writer in a folder of ours."""
    if at_step and event in CHANGES and (event == "ctypes.dlsym" or _ours(arguments)):
        at_step[0]()


def _ours(arguments: tuple[Any, ...]) -> bool:
    return any(isinstance(a, str | bytes | Path) and "together-" in os.fsdecode(a) for a in arguments[:2]) or any(
        isinstance(a, int) and a > 2
        for a in arguments[1:]  # beside an open folder, as rmtree works
    )


def write(folder: Path, names: tuple[str, ...], text: str) -> None:
    """Write files of one answer together."""
    replace_together(folder, NAMES, lambda new: [(new / name).write_text(text) for name in names])


def answer(folder: Path) -> dict[str, str]:
    """Return the files of the answer with what is in them."""
    return {name: (folder / name).read_text() for name in NAMES if (folder / name).is_file()}


def hidden(root: Path) -> list[Path]:
    """Return the hidden folders left behind."""
    return [path for path in root.rglob("*") if NAME.fullmatch(path.name)]


def prepared(root: Path, way: str) -> Path:
    """Return a folder as it was before."""
    others, before, _ = WAYS[way]
    folder = root / "there"
    if others or before:
        folder.mkdir()
    for name in (*others, *before):
        (folder / name).write_text("old")
    return folder


def ended(folder: Path, coming: tuple[str, ...], step: int, act: Callable[[], None]) -> int:
    """Return how a writer that acts at a step ends: 0 had fewer steps, 3 made nothing of it, 5 an error, -9 killed."""
    child = os.fork()
    if child:
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    count = itertools.count(1)

    def acting() -> None:
        if next(count) == step:
            act()

    at_step.append(acting)
    try:
        write(folder, coming, "new")
    except OSError:
        os._exit(5)
    os._exit(0 if next(count) <= step else 3)


def faults(folder: Path, way: str, code: int) -> tuple[str, list[str]]:
    """Return which answer stands, and what is wrong with that after a writer has ended."""
    others, before, coming = WAYS[way]
    found = answer(folder)
    whole = {"old": dict.fromkeys(before, "old"), "new": dict.fromkeys(coming, "new")}
    state = next((word for word, files in whole.items() if files == found), "part")
    signs = {
        f"two answers: {found}": len(set(found.values())) > 1,
        "no file at all": state == "part" and not found and bool(set(before) & set(coming)),
        f"not whole: {found}, exit {code}": state == "part" and (code == 5 or not others),
        f"exit {code}, and {state}": (code, state) in ((5, "new"), (3, "old"), (0, "old")),
        "another file was changed": any((folder / other).read_text() != "old" for other in others),
        "hidden files after an error": code == 5 and bool(hidden(folder.parent)),
    }
    return state, [word for word, found_so in signs.items() if found_so]


def tried(way: str, step: int, act: Callable[[], None]) -> tuple[str, list[str], bool]:
    """Return which answer stands after `act` at a step of the writer, what is wrong, and whether there was the step."""
    with tempfile.TemporaryDirectory(prefix="together-", dir=MEMORY) as name:
        folder = prepared(Path(name), way)
        code = ended(folder, WAYS[way][2], step, act)
        state, wrong = faults(folder, way, code)
        write(folder, NAMES, "next")
        if answer(folder) != dict.fromkeys(NAMES, "next") or hidden(folder.parent):
            wrong.append(f"the next run leaves {sorted(folder.parent.rglob('*'))}")
        return state, [f"{way}, step {step}: {word}" for word in wrong], code != 0


def die() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def fail() -> None:
    raise OSError(5, "Input/output error")


def each_step(act: Callable[[], None]) -> list[str]:
    """Try every step of every way of writing."""
    wrong: list[str] = []
    for way in WAYS:
        states: Counter[str] = Counter()
        for step in itertools.count(1):
            state, found, again = tried(way, step, act)
            wrong += found
            if not again:
                break
            states[state] += 1
        print(f"{way}: {step - 1} steps, {dict(states)}")
    return wrong


def crowd(writers: int = 4, times: int = 40) -> list[str]:
    """Let several processes write into one folder, some with a file beside, and look at it between."""
    wrong: list[str] = []
    with tempfile.TemporaryDirectory(prefix="together-", dir=MEMORY) as name:
        folder = Path(name, "there")
        write(folder, NAMES, "first")
        children = []
        for writer in range(writers):
            child = os.fork()
            if not child:
                for time in range(times):
                    if writer == 0:
                        (folder / "mine.txt").touch() if time % 2 else (folder / "mine.txt").unlink(missing_ok=True)
                    write(folder, NAMES if (time + writer) % 3 else NAMES[:1], f"{writer}.{time}")
                os._exit(0)
            children.append(child)
        looks = 0
        while children:
            with alone_in(folder):
                found = answer(folder)
            looks += 1
            if len(set(found.values())) != 1 or set(found) not in (set(NAMES), set(NAMES[:1])):
                wrong.append(f"look {looks}: {found}")
            ended, status = os.waitpid(-1, os.WNOHANG)
            if ended:
                children.remove(ended)
                if status:
                    wrong.append(f"writer ended with {status}")
        if hidden(Path(name)):
            wrong.append(f"left: {hidden(Path(name))}")
        print(f"{writers} writers, {times} times each, {looks} looks")
    return wrong


def main() -> None:
    """Try, and print what is wrong."""
    sys.addaudithook(hook)
    what = sys.argv[1]
    wrong = crowd() if what == "crowd" else each_step({"kill": die, "fail": fail}[what])
    print(*wrong, f"{len(wrong)} wrong", sep="\n")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
