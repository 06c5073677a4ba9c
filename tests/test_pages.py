"""README.md and docs: every block runs and prints what is shown, every command exists, every link leads somewhere."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import pytest
import yaml
from command_line import run
from pages import ROOT, blocks, judge_block, ran, user_pages
from typer.main import get_command

from synergrip.cli.app import app

PAGES = {str(page.relative_to(ROOT)): page for page in user_pages()}
RUN = [name for name, page in PAGES.items() if {"bash", "python"} & {block.kind for block in blocks(page)}]
MADE = {"docs/in-code.md": {"ball.svg", "margins.png", *(f"out/ball/plan.{each}" for each in ("json", "npz", "csv"))}}
"""Files that a page makes and does not show by their names."""
KINDS = {"bash", "python", "text", "toml", "xml", "csv", "json", "console"}


@pytest.mark.parametrize("name", RUN)
def test_a_page_runs_from_top_to_bottom_and_prints_what_it_shows(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for block, printed in ran(PAGES[name]):
        judge_block(block, printed)
    made = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()}
    assert made >= MADE.get(name, set())
    shown = " ".join(block.shown or "" for block in blocks(PAGES[name]))
    told = set(re.findall(r"(?<!\S)out/\S+\.\w+", shown))
    assert {path for path in made if "/export/" in path} <= told <= made


def test_every_block_is_of_a_kind_that_is_run_or_shown() -> None:
    for name, page in PAGES.items():
        fences = re.findall(r"^```.*$", page.read_text(encoding="utf-8"), re.MULTILINE)
        assert len(fences) == 2 * len(blocks(page)), f"{name}: a block that is not closed, or without a language"
        assert {block.kind for block in blocks(page)} <= KINDS, name


def read(arguments: list[str], group: Any) -> None:
    """Read arguments as the command line would; those of a verb alone, as it is named in a sentence, may lack some."""
    verb, *rest = arguments
    assert verb in group.commands, f"no verb {verb}"
    command = group.commands[verb]
    if hasattr(command, "commands") and rest:
        read(rest, command)
    else:
        command.make_context(verb, rest, resilient_parsing=not rest)


def test_every_command_that_a_page_names_exists_with_its_options() -> None:
    named = [
        command
        for page in PAGES.values()
        for command in re.findall(r"`synergrip ([^`]+)`", page.read_text(encoding="utf-8"))
        if "..." not in command and command[0] not in "-V"
    ]
    assert len(named) > 30
    for command in named:
        read(shlex.split(command.partition(" > ")[0]), get_command(app))


def test_the_commands_of_the_readme_find_their_files_in_the_checkout() -> None:
    named = re.findall(r"\| `synergrip ([^`]+)`", PAGES["README.md"].read_text(encoding="utf-8"))
    given = [word for command in named for word in shlex.split(command) if word.endswith((".csv", ".toml"))]
    assert [word for word in given if not (ROOT / word).is_file()] == ["mine.toml"], "which is written"


def anchors(text: str) -> set[str]:
    """Return the anchors of the headings of a page."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE), re.MULTILINE)
    plain = (re.sub(r"[^\w\s-]", "", heading).strip().lower() for heading in headings)
    return {re.sub(r"[-\s]+", "-", heading) for heading in plain}


def test_links_lead_somewhere() -> None:
    others = ("CONTRIBUTING.md", "problems/README.md", "models/README.md")
    for page in (*PAGES.values(), *(ROOT / name for name in others)):
        text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
        for link in re.findall(r"\]\(([^)\s]+)\)", text):
            target, _, anchor = unquote(link).partition("#")
            there = page.parent / target if target else page
            assert there.exists(), f"{page.name}: {link}"
            assert not anchor or anchor in anchors(there.read_text(encoding="utf-8")), f"{page.name}: {link}"


def test_every_page_is_in_the_navigation_of_the_site() -> None:
    def files(entry: object) -> list[str]:
        if isinstance(entry, str):
            return [entry]
        parts = entry if isinstance(entry, list) else list(entry.values())  # type: ignore[attr-defined]
        return [file for part in parts for file in files(part)]

    named = files(yaml.safe_load((ROOT / "mkdocs.yml").read_text(encoding="utf-8"))["nav"])
    assert len(named) == len(set(named))
    assert set(PAGES) <= set(named)
    assert all((ROOT / name).is_file() for name in named)


def test_the_readme_is_short_and_begins_with_the_two_commands() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert len(text.splitlines()) < 150
    first, second = (block.text for block in blocks(ROOT / "README.md") if block.kind == "bash")
    assert ".venv/bin/synergrip plan" in first
    assert ".venv/bin/pytest" in second


def test_the_code_of_all_pages_is_written_for_the_type_checker(tmp_path: Path) -> None:
    script = Path(__file__).parent / "code_of_pages.py"
    subprocess.run([sys.executable, str(script), str(tmp_path)], check=True, capture_output=True)
    named = {path.name for path in tmp_path.iterdir()}
    assert {"docs_in_code_page.py", "docs_tutorials_embedding_page.py"} <= named


def test_the_citation_names_software_and_paper() -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert {"cff-version", "message", "title", "authors"} <= set(citation)
    assert citation["title"] == "synergrip"
    assert "Postural Synergies" in citation["references"][0]["title"]


def test_the_help_names_the_file_that_the_pages_begin_with() -> None:
    for arguments in (["--help"], []):
        told = re.search(r"^ Documentation: (.+)$", run(*arguments).stdout, re.MULTILINE)
        assert told is not None
        assert Path(told[1]).read_bytes() == (ROOT / "README.md").read_bytes()  # the same file, or that of the wheel


def test_a_verb_names_all_pages() -> None:
    told = run("docs").stdout
    head = re.match(r"Documentation:\s+(.+)\n", told)  # on a line of its own where it is long
    assert head is not None
    assert Path(head[1]).read_bytes() == (ROOT / "README.md").read_bytes()
    found = json.loads(run("docs", "--format", "json").stdout)
    folder = Path(head[1]).parent.resolve()
    told_pages = {Path(each["file"]).resolve().relative_to(folder) for each in found["pages"]}
    assert told_pages == {page.relative_to(ROOT) for page in (ROOT / "docs").rglob("*.md")}
    assert re.search(r"docs/margins\.md +\w", told)
