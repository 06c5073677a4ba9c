"""The problem file: what may stand in it, and how it is read."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from pydantic import Field

from synergrip.documents.documents import Document, parse, read_document
from synergrip.documents.fields import Schema, Table, Version
from synergrip.errors import InputError, Issue
from synergrip.grasps.contact_at import ContactAt
from synergrip.grasps.matrices import MOST_CONTACTS
from synergrip.problems.allow_table import AllowTable
from synergrip.problems.contact_list import contact_list
from synergrip.problems.contact_tables import ContactEntry, ContactsTable
from synergrip.problems.hand_table import GraspTable, HandTable
from synergrip.problems.limits_file import ExpectTable, GoalTable, LimitsTable, OutputTable
from synergrip.problems.object_table import ObjectTable
from synergrip.problems.task_file import TaskTable


class ProblemFile(Table):
    """A planning problem: what grasps what, what is to happen, within which limits, to which end."""

    version: Version = Field(alias="schema", description="version of the file format: 1")
    title: str = Field(default="", description="what the problem is, in a line")
    description: str = Field(default="", description="what the problem is, at length")
    grasp: GraspTable | None = Field(
        default=None, description="a grasp given as matrices; instead of hand, object, contacts"
    )
    hand: HandTable | None = Field(default=None, description="the hand, its posture and its synergies")
    object: ObjectTable | None = Field(default=None, description="the grasped object")
    contacts: ContactsTable | None = Field(
        default=None, description="the pads that touch, and defaults for all contacts"
    )
    contact: tuple[ContactEntry, ...] = Field(
        default=(), max_length=MOST_CONTACTS, description="contacts that differ from the defaults"
    )
    task: TaskTable = Field(default_factory=TaskTable, description="what is to happen")
    limits: LimitsTable = Field(default_factory=LimitsTable, description="what the plan must keep")
    allow: AllowTable | None = Field(
        default=None, description="values for all of which the plan is to hold, beside those stated"
    )
    goal: GoalTable = Field(
        default_factory=GoalTable,
        description="which plan is chosen; least effort when absent",
    )
    output: OutputTable = Field(default_factory=OutputTable, description="what is written")
    expect: ExpectTable | None = Field(default=None, description="the expected answer, for tests")

    def contact_list(self) -> tuple[ContactAt, ...]:
        """Return every contact with the defaults filled in; empty for a grasp given as matrices."""
        return () if self.grasp else contact_list(self.contacts, self.contact)

    def issues(self) -> Iterable[Issue]:
        """Refuse two grasps, half a grasp, incomplete contacts, and gravity on no mass."""
        parts = [name for name in ("hand", "object", "contacts", "contact") if getattr(self, name)]
        if self.grasp:
            for name in parts:
                yield Issue(f"[{name}] and [grasp] exclude each other; keep one of them", key=name, on_key=True)
        elif not parts:
            yield Issue("nothing to grasp with: give [grasp], or [hand], [object] and [contacts]")
        else:
            for name in ("hand", "object"):
                if name not in parts:
                    yield Issue(f"missing table [{name}]", key=name, on_key=True)
            try:
                self.contact_list()
            except InputError as error:
                yield from error.issues
        if self.task.gravity is not None and (self.object is None or self.object.mass is None):
            given = "a grasp file has no mass; give the weight in task.wrench" if self.grasp else "give object.mass"
            yield Issue(f"gravity needs the mass of the object: {given}", key="task.gravity")


def read_problem_file(path: Path, overrides: Sequence[str] = ()) -> tuple[ProblemFile, Document]:
    """Read a problem file, with ``KEY=VALUE`` texts put over it.

    Args:
        path: a ``.toml`` or ``.json`` file.
        overrides: such as ``limits.margin=0.3 N``.

    Returns:
        The checked values in SI units, and the document that knows where each of them stands.

    Raises:
        InputError: all the issues of the file, each with its place.
    """
    document = read_document(path, "problem file").with_overrides(overrides)
    return parsed(document), document


def parsed(document: Document) -> ProblemFile:
    """Return the checked values of a document; where some are wrong, what is wrong with the hand is told with them.

    Raises:
        InputError: all the issues of the file, each with its place.
    """
    try:
        return parse(document, ProblemFile)
    except InputError as error:
        # it reads hands, which a file in order does not need here
        from synergrip.problems.hand_beside import hand_issues

        newer = any(issue.key == "schema" for issue in error.issues)
        beside = [] if newer else [document.locate(issue) for issue in hand_issues(document, error.issues)]
        found = [*error.issues, *(issue for issue in beside if issue not in error.issues)]
        raise InputError(sorted(found, key=lambda issue: (issue.file, issue.line, issue.column))) from None


def problem_schema() -> dict[str, Any]:
    """Return the JSON Schema (draft 2020-12) of the problem file, for editors."""
    schema: Schema = _without_null(ProblemFile.model_json_schema(by_alias=True))
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def _without_null(node: Any) -> Any:
    """Return the schema without the null that stands for "absent" in Python and does not exist in TOML."""
    if isinstance(node, list):
        return [_without_null(entry) for entry in node]
    if not isinstance(node, dict):
        return node
    result = {key: _without_null(entry) for key, entry in node.items() if not (key == "default" and entry is None)}
    options = result.get("anyOf", [])
    if {"type": "null"} in options:
        kept = [option for option in options if option != {"type": "null"}]
        del result["anyOf"]
        result = {**kept[0], **result} if len(kept) == 1 else {**result, "anyOf": kept}
    return result
