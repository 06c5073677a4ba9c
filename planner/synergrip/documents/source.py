"""What was asked, as it was written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from json import dumps
from typing import Any


@dataclass(frozen=True)
class Source:
    """A question, to be kept beside its answer."""

    name: str
    content: str | Mapping[str, Any]
    """The text of a file, or a dict of its structure."""
    overrides: tuple[str, ...] = ()

    @property
    def sha256(self) -> str:
        """Of the text in UTF-8, or of the dict as JSON with sorted keys."""
        content = self.content
        text = content if isinstance(content, str) else dumps(content, sort_keys=True, separators=(",", ":"))
        return sha256(text.encode()).hexdigest()
