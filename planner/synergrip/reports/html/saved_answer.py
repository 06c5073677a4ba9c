"""An answer that was written before, as its report needs it: whole, and as it was written."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from os.path import exists, isfile  # unlike those of Path, no error for a name that is too long
from pathlib import Path
from typing import Any

from synergrip.documents.documents import read_document
from synergrip.errors import InputError, shortened
from synergrip.planning.digest import unchanged
from synergrip.planning.provenance import KEY as PROVENANCE
from synergrip.simulation.told_values import Told

KEY = "PLAN"
LONGEST_WHY = 120
"""Letters of what a library says of a value that are shown."""


def read_answer(file: Path) -> tuple[Mapping[str, Any], str]:
    """Return the document in a plan.json, and the text of the plan.csv beside it, empty when there is none.

    Raises:
        InputError: no such file, no answer, or one that is no longer as it was written, as far as a digest or the types
            of what stands outside of it tell.
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
    _judge_provenance(Told(data, ""))
    table = file.with_suffix(".csv")
    return data, table.read_text(encoding="utf-8") if table.is_file() else ""


@contextmanager
def shown(file: Path) -> Iterator[None]:
    """Let what is missing in an answer, or is something else than synergrip writes there, be told as what it is.

    A digest says that a document is as it was written; not that it was written by this version.
    """
    try:
        yield
    except InputError:
        raise
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        what = f"{type(error).__name__}: {shortened(str(error), LONGEST_WHY)}"
        message = f"'{file}' lacks something that is shown, or has something else in its place ({what})"
        advice = "plan again; if that does not help, it is a defect of synergrip, please report it"
        raise InputError.at(KEY, f"{message}; {advice}") from error


def _judge_provenance(told: Told) -> None:
    """Raise an `InputError` where an answer says in another way than synergrip where it comes from.

    The digest leaves that out, and what is shown of it is its text.
    """
    if told.get(PROVENANCE) is None:
        return
    found = told.inside(PROVENANCE)
    if found.get("overrides") is not None:
        found.texts("overrides")
    _judge_texts(found, "version", "solver", "date")
    if found.get("problem") is None:
        return
    problem = found.inside("problem")
    _judge_texts(problem, "name", "text", "sha256")
    if problem.get("dict") is not None:
        problem.inside("dict")


def _judge_texts(told: Told, *names: str) -> None:
    for name in names:
        if told.get(name) is not None:
            told.text(name)


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
