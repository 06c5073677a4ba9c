"""A plan on disk: plan.json, plan.npz and plan.csv, or a no with its proof; they change together or not at all."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from synergrip.files import refuse_unwritable_folder
from synergrip.grasps.grasp import Grasp
from synergrip.planning.answer import FORMATS
from synergrip.planning.arrays import arrays_of, columns_of, names_of, table_of
from synergrip.planning.digest import digest
from synergrip.planning.outcome import Outcome, Plan
from synergrip.together import refuse_others, replace_together

PROOF, REPORT = "proof.json", "report.html"
NOTHING: Mapping[str, str] = MappingProxyType({})
NAMES = (*(f"plan.{suffix}" for suffix in FORMATS), PROOF, REPORT)


def write_outcome(
    folder: Path,
    document: dict[str, Any],
    outcome: Outcome,
    formats: tuple[str, ...],
    proof: dict[str, Any] | None = None,
    report: str | None = None,
    more: Mapping[str, str] = NOTHING,
) -> list[str]:
    """Write an outcome into `folder` and return the names of the files written.

    An outcome without a plan has only a document, and perhaps an exact proof; either may have its report. Files of
    an earlier run that are not written anew are removed, so that the folder never holds the answer to another question,
    nor files of two answers.

    Args:
        folder: where; made when it is missing.
        document: of the outcome.
        outcome: what was found.
        formats: of plan.json, plan.csv and plan.npz.
        proof: exact, of a no.
        report: text of its page.
        more: texts of files that are written with it, by their names.

    Raises:
        OSError: it cannot be done; the folder is as it was.
    """
    writers: dict[str, Callable[[Path], object]] = {
        "json": lambda path: path.write_text(to_json(document) + "\n", encoding="utf-8")
    }
    if isinstance(outcome, Plan):
        writers["csv"] = lambda path: path.write_text(plan_csv(outcome), encoding="utf-8")
        writers["npz"] = lambda path: _write_npz(path, outcome)
    chosen = [suffix for suffix in writers if suffix in formats]

    def write(new: Path) -> None:
        for suffix in chosen:
            writers[suffix](new / f"plan.{suffix}")
        if proof is not None:
            (new / PROOF).write_text(to_json(proof) + "\n", encoding="utf-8")
        if report is not None:
            (new / REPORT).write_text(report, encoding="utf-8")
        for name, text in more.items():
            (new / name).write_text(text, encoding="utf-8")

    replace_together(folder, (*NAMES, *more), write)
    pages = [*[PROOF] * (proof is not None), *[REPORT] * (report is not None)]
    return [*(f"plan.{suffix}" for suffix in chosen), *pages, *more]


def refuse_place(folder: Path) -> None:
    """Raise the OSError that says why no outcome can be written into `folder`, as far as it can be told beforehand."""
    refuse_unwritable_folder(folder)
    refuse_others(folder, NAMES)


def to_json(document: dict[str, Any]) -> str:
    """Return the document as JSON text; a number that is not finite is a defect and raises ValueError."""
    return json.dumps(document, allow_nan=False)


def plan_csv(plan: Plan) -> str:
    """Return one line per knot: time, references, contact forces, joint torques, object displacement, margins."""
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerow(header_of(plan.grasp))  # with quotes around names with commas
    np.savetxt(stream, table_of(plan.moved), fmt="%.17g", delimiter=",")
    return stream.getvalue()


def csv_of(outcome: Outcome) -> str:
    """Return the text of plan.csv; of an answer without a plan, nothing."""
    return plan_csv(outcome) if isinstance(outcome, Plan) else ""


def header_of(grasp: Grasp) -> list[str]:
    """Return the names of all columns of plan.csv."""
    return [name for names in columns_of(grasp).values() for name in names]


def _write_npz(path: Path, plan: Plan) -> None:
    named = {key: np.array(names) for key, names in names_of(plan.grasp).items()}
    arrays = arrays_of(plan.moved) | named
    with path.open("wb") as stream:
        np.savez(stream, **arrays, digest=np.array(digest(arrays, sorted(arrays))))
