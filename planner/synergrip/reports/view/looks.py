"""What stands beside a view: what is shown and hidden, notes, and a table of where everything is."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from synergrip.reports.view.marks import Marks, millimetres
from synergrip.reports.view.scene import Frame, Scene


def looks(gui: Any, marks: Marks) -> None:
    """Add what shows and hides frames and names, on `viser.GuiApi`."""
    with gui.add_folder("Frames"):
        shown = {"link frames": (marks.links, True), "link names": (marks.names, False),
                 "pad frames": (marks.pads, True), "pad names": (marks.places, marks.named)}  # fmt: skip
        for name, (what, seen) in shown.items():
            box = gui.add_checkbox(name, seen)
            box.on_update(lambda _, box=box, what=what: marks.let(what, seen=box.value))


def table_of(scene: Scene, frame: Frame) -> str:
    """Return where pads, contacts, the object and links are, as a table (Markdown)."""
    rows = [(f"pad {name}", place) for name, place in zip(scene.pad_names, frame.pads, strict=True)]
    if scene.contacts or scene.shape is not None:
        rows.append(("object", frame.position))
    rows += [(f"contact {label}", place) for label, place in zip(frame.labels, frame.places, strict=True)]
    rows += [(f"link {name}", place) for name, place in zip(scene.link_names, frame.links, strict=True)]
    return "\n".join(
        ["| | x, y, z |", "| --- | --- |", *(f"| {plain(name)} | {millimetres(at)} |" for name, at in rows)]
    )


def notes_text(notes: Sequence[str]) -> str:
    """Return notes as a list (Markdown)."""
    return "\n".join(f"- {plain(note)}" for note in notes)


def headline(text: str) -> str:
    """Return a title as Markdown: bold, so that no word of it begins a line and is taken for a statement."""
    return f"**{plain(text)}**" if text.strip() else ""


def plain(text: str) -> str:
    """Return a text of the user as Markdown that shows it as it is."""
    return "".join(f"\\{mark}" if mark in "\\`*_{}[]()<>#+|!~$&" else mark for mark in " ".join(text.split()))
