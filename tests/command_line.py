"""The command line, run in this process."""

from __future__ import annotations

import json
from typing import Any

from typer.testing import CliRunner, Result

from synergrip.cli.app import app


def run(*arguments: str) -> Result:
    """Return what ``synergrip ARGUMENTS`` ends in; what it raises is raised."""
    result = CliRunner().invoke(app, arguments)
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    assert "Traceback" not in result.output
    return result


def document(*arguments: str, code: int = 0) -> dict[str, Any]:
    """Return the one JSON document on standard output."""
    return document_of(run(*arguments, "--format", "json"), code)


def document_of(result: Result, code: int = 0) -> dict[str, Any]:
    assert result.exit_code == code, result.output
    found = json.loads(result.stdout)  # refuses anything before or after it
    assert isinstance(found, dict)
    return found
