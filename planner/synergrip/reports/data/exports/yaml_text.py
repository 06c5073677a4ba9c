"""YAML with a head of comments, by PyYAML."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from synergrip.reports.data.exports.exported_plan import ExportedPlan


def write_yaml(path: Path, plan: ExportedPlan, remarks: Iterable[str], document: dict[str, Any]) -> None:
    """Write a document below comments that say what it is and where it comes from; numbers keep all their digits."""
    import yaml

    head = [*remarks, *(f"{key}: {value}" for key, value in plan.about.items())]
    comments = "".join(f"# {line}\n" for line in head)
    text = yaml.safe_dump(document, sort_keys=False, allow_unicode=True, default_flow_style=None, width=1 << 30)
    path.write_text(comments + text, encoding="utf-8")
