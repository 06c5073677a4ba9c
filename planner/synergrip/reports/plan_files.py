"""A plan on disk: plan.json, plan.npz and plan.csv, each written whole or not at all."""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.files import atomic_path
from synergrip.plans.digest import digest
from synergrip.plans.outcome import Outcome, Plan
from synergrip.plans.told import arrays_of, columns_of, table_of

FORMATS = ("json", "npz", "csv")


def write_outcome(folder: Path, document: dict[str, Any], outcome: Outcome, formats: tuple[str, ...]) -> list[str]:
    """Write an outcome into `folder` and return the names of the files written.

    An outcome without a plan has only a document. Files of an earlier run that are not written anew are removed,
    so that the folder never holds the answer to another question.
    """
    writers: dict[str, Callable[[Path], object]] = {
        "json": lambda path: path.write_text(to_json(document) + "\n", encoding="utf-8")
    }
    if isinstance(outcome, Plan):
        writers["csv"] = lambda path: path.write_text(plan_csv(outcome), encoding="utf-8")
        writers["npz"] = lambda path: _write_npz(path, outcome)
    written = [f"plan.{suffix}" for suffix in writers if suffix in formats]
    with ExitStack() as all_or_none:  # every file is complete before the first one takes its place
        for name in written:
            writers[name.removeprefix("plan.")](all_or_none.enter_context(atomic_path(folder / name)))
    for name in {f"plan.{suffix}" for suffix in FORMATS} - set(written):
        (folder / name).unlink(missing_ok=True)
    return written


def to_json(document: dict[str, Any]) -> str:
    """Return the document as JSON text; a number that is not finite is a defect and raises ValueError."""
    return json.dumps(document, allow_nan=False)


def plan_csv(plan: Plan) -> str:
    """Return one line per knot: time, references, contact forces, joint torques, object displacement, margins."""
    header = ["t_s", *(name for names in columns_of(plan.analysis.grasp).values() for name in names)]
    table = table_of(plan.motion, plan.margins)
    stream = io.StringIO()
    np.savetxt(stream, table, fmt="%.17g", delimiter=",", header=",".join(header), comments="")
    return stream.getvalue()


def _write_npz(path: Path, plan: Plan) -> None:
    motion, grasp = plan.motion, plan.analysis.grasp
    arrays = arrays_of(motion, (plan.alpha, plan.beta, plan.gamma), plan.analysis.spaces.Gamma_ucs) | {
        "time_s": motion.times, "margin": plan.margins,
        "joints": np.array(grasp.joints), "synergies": np.array(grasp.synergies),
        "contacts": np.array([contact.name for contact in grasp.contacts]),
    }  # fmt: skip
    with path.open("wb") as stream:
        np.savez(stream, allow_pickle=False, **arrays, digest=np.array(digest(arrays, sorted(arrays))))
