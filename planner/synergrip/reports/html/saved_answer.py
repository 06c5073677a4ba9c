"""An answer that was written before, as its report needs it: whole, and as it was written."""

from __future__ import annotations

from collections.abc import Mapping
from os.path import exists, isfile  # unlike those of Path, no error for a name that is too long
from pathlib import Path
from typing import Any

from synergrip.documents.documents import read_document
from synergrip.errors import InputError
from synergrip.planning.digest import unchanged

KEY = "PLAN"


def read_answer(file: Path) -> tuple[Mapping[str, Any], str]:
    """Return the document in a plan.json, and the text of the plan.csv beside it, empty when there is none.

    Raises:
        InputError: no such file, no answer, or one that is no longer as it was written.
    """
    data = read_document(file, "plan", KEY, numbers=True).data
    if "verdict" not in data or "time_s" not in data:
        message = f"'{file}' holds no answer: verdict and time_s are missing; make one with `synergrip plan PROBLEM`"
        raise InputError.at(KEY, message)
    same = unchanged(data)
    if same is None:
        raise InputError.at(KEY, f"'{file}' has no digest, so nobody knows whether it is whole; plan again")
    if not same:
        message = f"'{file}' is not as it was written, and a report shows what was found; plan again, or"
        raise InputError.at(KEY, f"{message} judge what is in it with `synergrip check`")
    table = file.with_suffix(".csv")
    return data, table.read_text(encoding="utf-8") if table.is_file() else ""


def saved_file(path: Path, key: str = KEY) -> Path | None:
    """Return the file of a saved answer, None for anything else, such as a problem.

    Args:
        path: of the answer, or of its folder.
        key: where it stands, for errors of a file that cannot be read.
    """
    inside = path / "plan.json"
    if isfile(inside):
        return inside
    if path.suffix != ".json" or not exists(path):
        return None
    return path if "verdict" in read_document(path, "problem or plan", key, numbers=True).data else None
