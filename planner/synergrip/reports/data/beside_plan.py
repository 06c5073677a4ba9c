"""A document that was saved beside a plan, found again and tied to that very plan by digests."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

from synergrip.documents.documents import read_document
from synergrip.errors import InputError
from synergrip.planning.digest import stated_digest, unchanged

T = TypeVar("T")


def found_beside(
    file: Path, what: str, plan: Mapping[str, Any], read: Callable[[Mapping[str, Any]], T]
) -> T | str | None:
    """Return what is read from a file of this very plan, why that which is there is none, or None without any.

    Args:
        file: which is looked for.
        what: its document is, for errors.
        plan: document of the plan, as in plan.json, whose digest has been judged.
        read: reads the document; its `InputError` says why that is none.
    """
    if not file.is_file():
        return None
    try:
        data = read_document(file, what, numbers=True).data
        json.dumps(data, ensure_ascii=False).encode()
        if not unchanged(data):
            return "is not as it was written" if stated_digest(data) else "does not say of which plan it is"
        if data.get("plan_sha256") is None or data["plan_sha256"] != stated_digest(plan):
            return "is of another plan"
        return read(data)
    except InputError as error:
        return f"cannot be read: {error.issues[0].message}"
    except UnicodeEncodeError:  # half of a letter, which JSON can write and no page
        return "cannot be read: a text in it is none"
