"""The pages for users: their blocks of code, run from top to bottom as a reader would run them.

A block with a title is a file that the reader saves under that name; files in the folder that is named as the page are
copied. A command or a program that is followed by a block ``text`` prints what that block shows; one without ends well.
"""

from __future__ import annotations

import contextlib
import io
import logging
import re
import shlex
import shutil
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from command_line import run

ROOT = Path(__file__).parent.parent
BLOCK = re.compile(r"^```(\w+)(?: title=\"([^\"]+)\")?\n(.*?)^```$", re.DOTALL | re.MULTILINE)
NUMBER = r"\d+(?:\.\d+)?(?:e[-+]\d+)?"
VOLATILE = re.compile(rf"{NUMBER} ms(?:, \d+ attempts)?|\d+(?:\.\d+)?e[-+]\d+|\d+ iterations|Clarabel [\d.]+")
"""Residuals, iterations, attempts, times and versions: the machine's, not the answer's."""
RUN_BY_CI = re.compile(r"(\.venv/bin/)?pip install|python3 -m venv")


@dataclass(frozen=True)
class Block:
    """A block of code: its language, the file that it is, if any, its text, and what a block right after it shows."""

    kind: str
    title: str
    text: str
    shown: str | None
    shown_at: int
    """Where in the page that begins, or -1."""


def user_pages() -> list[Path]:
    """Return README.md and all pages of docs."""
    return [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


def blocks(page: Path) -> list[Block]:
    """Return the blocks of a page in their order."""
    text = page.read_text(encoding="utf-8")
    found = list(BLOCK.finditer(text))
    shown = {
        one.start(): (after[3], after.start(3))
        for one, after in pairwise(found)
        if after[1] == "text" and not after[2] and not text[one.end() : after.start()].strip()
    }
    return [Block(*each.groups(default=""), *shown.get(each.start(), (None, -1))) for each in found]


def judge(printed: str, shown: str, *, volatile: re.Pattern[str] | None = None) -> None:
    """Assert that words are the same, and numbers to one in the last digit that is shown.

    A number without a fraction counts or names something, and is the same; where there are none, spaces are, too.
    """
    if not re.search(NUMBER, shown):
        assert printed == shown
    if volatile is not None:
        printed, shown = volatile.sub("#", printed), volatile.sub("#", shown)
    assert re.sub(NUMBER, "#", printed).split() == re.sub(NUMBER, "#", shown).split()
    for number, other in zip(re.findall(NUMBER, printed), re.findall(NUMBER, shown), strict=True):
        assert abs(float(number) - float(other)) <= 1.01 * last_digit(other), (number, other)


def last_digit(number: str) -> float:
    """Return what one more in the last digit is worth; nothing in a number without a fraction."""
    digits, _, exponent = number.partition("e")
    fraction = len(digits.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - fraction) if fraction else 0.0


def commands(block: Block) -> Iterator[tuple[list[str], int | None]]:
    """Yield the arguments of each ``synergrip`` of a block, with the exit code that a comment tells.

    What installs and tests is run by .ci/run.
    """
    for line in block.text.replace("\\\n", " ").splitlines():
        start, found, arguments = line.rpartition("synergrip ")
        if found:
            assert re.fullmatch(r"(.*&& )?(\.venv/bin/)?", start), line
            yield shlex.split(arguments, comments=True), told_code(line)
        else:
            assert not line.strip() or RUN_BY_CI.match(line), f"neither run here nor by .ci/run: {line}"


def told_code(text: str) -> int | None:
    """Return the exit code that a text ends with."""
    told = re.search(r"exit code (\d)$", text, re.MULTILINE)
    return int(told[1]) if told else None


def run_commands(block: Block) -> str:
    """Return what the commands of a block print; one that shows a no ends with 1, whether that is shown or not."""
    printed = ""
    for arguments, told in commands(block):
        result = run(*arguments)
        printed += result.stdout
        told = told if block.shown is None else told_code(block.shown)
        expected = {told} if told is not None else {0} if block.shown is None else {0, 1}
        assert result.exit_code in expected, result.output
    return printed


def run_program(block: Block, space: dict[str, object]) -> str:
    """Return what the program of a block prints."""
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(block.text, "page", "exec"), space)
    return printed.getvalue()


def ran(page: Path) -> Iterator[tuple[Block, str]]:
    """Run the blocks of a page in the folder where we are, and yield each with what it prints."""
    logger = logging.getLogger("synergrip")
    level, space, beside = logger.level, {"__name__": "page"}, page.with_suffix("")
    sys.modules["page"] = type(sys)("page")  # where dataclasses look for their module
    try:
        if beside.is_dir():
            shutil.copytree(beside, ".", dirs_exist_ok=True)
        for block in blocks(page):
            if block.title:
                Path(block.title).write_text(block.text, encoding="utf-8")
            elif block.kind == "bash":
                yield block, run_commands(block)
            elif block.kind == "python":
                yield block, run_program(block, space)
    finally:
        logger.setLevel(level)
        del sys.modules["page"]


def judge_block(block: Block, printed: str) -> None:
    """Assert that what a block prints is what is shown; what a command prints need not be shown."""
    if block.kind == "bash" and block.shown is not None:
        judge(printed, block.shown, volatile=VOLATILE)
    elif block.kind == "python":
        judge(printed, block.shown or "")
