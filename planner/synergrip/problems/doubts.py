"""What a problem states that can hardly be meant, as notes that name file, line, key and value."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from synergrip.documents.documents import read_document
from synergrip.errors import Issue
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.placing import same_spots
from synergrip.grasps.plausible import MOST_FRICTION, grasp_doubts
from synergrip.problems.contact_list import stated_in
from synergrip.problems.file_keys import in_file
from synergrip.problems.problem_file import ProblemFile


def doubts_of(grasp: Grasp, file: ProblemFile, folder: Path) -> tuple[Issue, ...]:
    """Return what of a grasp can hardly be meant, with keys of the problem file, or placed in the file of matrices.

    Args:
        grasp: as the file makes it.
        file: the problem file.
        folder: of the problem file.
    """
    return tuple(_placed(each, file, folder) for each in grasp_doubts(grasp, _friction_keys(grasp, file)))


def _friction_keys(grasp: Grasp, file: ProblemFile) -> Callable[[int, str], str]:
    """Return the function that says where a parameter of a contact is stated."""
    factors, table = grasp.factors.friction, "grasp" if file.grasp is not None else "contacts"
    names = grasp.contact_names

    def key(place: int, name: str) -> str:
        factor = factors.get(names[place], 1.0)
        if getattr(grasp.contacts[place].kind, name) / factor <= MOST_FRICTION:
            return f"{table}.friction_factor"
        if file.grasp is not None:
            return f"contacts[{place}].{name}"
        return stated_in(file.contacts, file.contact, name)[place]

    return key


def _placed(issue: Issue, file: ProblemFile, folder: Path) -> Issue:
    if file.grasp is not None and issue.key.startswith("contacts["):
        return read_document(folder / file.grasp.file, "grasp file", numbers=True).locate(issue)
    return in_file(issue)


def spot_notes(matrices: Path) -> tuple[str, ...]:
    """Return a note for each contact of a grasp file whose point is that of another one."""
    contacts = [
        data for data in read_document(matrices, "grasp file", numbers=True).data["contacts"] if data.get("point_m")
    ]
    points = [np.array(data["point_m"], dtype=float) for data in contacts]
    return tuple(message for _, message in same_spots([data["name"] for data in contacts], points))
