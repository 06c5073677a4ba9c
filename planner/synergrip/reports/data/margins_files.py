"""Margins on disk: margins.json, and palm.csv with the path of the palm where its fastest timing was asked for."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from synergrip.documents.documents import read_document
from synergrip.errors import InputError
from synergrip.files import refuse_unwritable_folder
from synergrip.margin.timing.fastest_timing import FastestTiming
from synergrip.reports.data.plan_files import to_json
from synergrip.simulation.told_values import Told
from synergrip.together import refuse_others, replace_together

FILE, TIMED = "margins.json", "palm.csv"


def write_margins(folder: Path, document: Mapping[str, Any], timing: FastestTiming | None = None) -> list[str]:
    """Write margins into a folder and return the names of the files written; a path of an earlier timing stays.

    Args:
        folder: made when it is missing.
        document: of the margins.
        timing: the fastest one, where it was asked for.

    Raises:
        OSError: it cannot be done; the folder is as it was.
    """
    timed = timing if timing is not None and timing.path is not None else None

    def write(new: Path) -> None:
        (new / FILE).write_text(to_json(dict(document)) + "\n", encoding="utf-8")
        if timed is not None:
            timed.write(new / TIMED)

    names = [FILE, TIMED] if timed is not None else [FILE]
    replace_together(folder, names, write)
    return names


def told_before(folder: Path, document: Mapping[str, Any]) -> list[str]:
    """Return the figures that margins of the same plan in a folder have, and a document that is to replace them not."""
    file = folder / FILE
    if not file.is_file():
        return []
    try:
        told = Told(read_document(file, "margins", numbers=True).data, "")
        found = told.inside("covers").texts("found")
    except InputError:  # they are no margins
        return []
    same = told.get("plan_sha256") == document["plan_sha256"]
    return [name for name in found if name not in document["covers"]["found"]] if same else []


def refuse_margins_place(folder: Path) -> None:
    """Raise the OSError that says why no margins can be written into `folder`, as far as it can be told before."""
    refuse_unwritable_folder(folder)
    refuse_others(folder, (FILE, TIMED))
