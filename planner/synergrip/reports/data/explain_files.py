"""An explanation on disk: explain.json."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from synergrip.files import refuse_unwritable_folder
from synergrip.reports.data.plan_files import to_json
from synergrip.together import refuse_others, replace_together

NAME = "explain.json"


def write_explanation(folder: Path, document: dict[str, Any]) -> Path:
    """Write the document of a no, or of the plan there is instead, into `folder`.

    Raises:
        OSError: it cannot be done; the folder is as it was.
    """
    replace_together(folder, (NAME,), lambda new: (new / NAME).write_text(to_json(document) + "\n", encoding="utf-8"))
    return folder / NAME


def refuse_explanation_place(folder: Path) -> None:
    """Raise the OSError that says why nothing can be written into `folder`, as far as it can be told beforehand."""
    refuse_unwritable_folder(folder)
    refuse_others(folder, (NAME,))
