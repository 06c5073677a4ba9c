"""The problem that a saved answer tells, read again, and whether it still has the same plan."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from hashlib import sha256
from os.path import isfile
from typing import Any

import numpy as np

from synergrip import __version__
from synergrip.errors import InputError
from synergrip.files import bundled
from synergrip.linalg import Array
from synergrip.planning.outcome import Plan
from synergrip.problems.problem import Problem, load_problem
from synergrip.simulation.told_values import Told

ROUNDING = 1e-5
"""Share of the largest reference by which another processor may come to others."""


def problem_of(document: Mapping[str, Any], key: str) -> Problem:
    """Return the problem of an answer; files that it names are looked for in the current folder unless it is bundled.

    Args:
        document: of the answer, as in plan.json.
        key: of the argument that named the answer, for errors.

    Raises:
        InputError: an answer that was made in code, or whose problem cannot be read again.
    """
    told = document.get("provenance")
    problem, overrides = (told.get(each) if isinstance(told, dict) else None for each in ("problem", "overrides"))
    if not isinstance(problem, dict):
        raise InputError.at(key, "this plan was made in code and does not tell its problem; give the problem itself")
    name, content = str(problem.get("name")), problem.get("text") or problem.get("dict") or {}
    shipped = bundled("problems") / f"{name}.toml"
    try:
        if isfile(shipped) and sha256(shipped.read_bytes()).hexdigest() == problem.get("sha256"):
            return load_problem(name, overrides or ())
        return load_problem(_read(content) if isinstance(content, str) else content, overrides or ())
    except (InputError, ValueError, TypeError) as error:  # of a text that is no TOML or JSON, too
        message = f"the problem '{name}' of this plan cannot be read again ({error}); give the problem file itself"
        raise InputError.at(key, message) from None


def _read(text: str) -> dict[str, Any]:
    """Return what a problem file says; no TOML begins with a brace, and all JSON of a problem does."""
    return dict(json.loads(text) if text.lstrip().startswith("{") else tomllib.loads(text))


def refuse_another(made: Plan, document: Mapping[str, Any], key: str) -> None:
    """Raise an `InputError` where planning the problem of a saved plan again has come to something else.

    Args:
        made: the plan that was made again.
        document: of the saved one, as in plan.json.
        key: of the argument that named it.
    """
    told = Told(document, "")
    try:
        times, references = told.array("time_s", (None,)), told.array("dz_r", (None, None))
        margin = told.inside("margin").number("worst_N")
    except InputError:
        same = False
    else:
        same = _alike(times, made.time) and _alike(references, made.dz_r)
        same = same and _alike(np.array(margin), np.array(made.usages[0].value.min()))
    if not same:
        version = (document.get("provenance") or {}).get("version")
        message = f"its problem, planned again, has another plan than this one, which synergrip {version} made of it"
        advice = "plan again, or give the problem instead; a file that the problem names may have changed"
        raise InputError.at(key, f"{message} (this is {__version__}); {advice}")


def _alike(told: Array, found: Array) -> bool:
    """Return whether numbers are the same but for rounding on another processor."""
    return told.shape == found.shape and bool(
        np.all(np.abs(told - found) <= ROUNDING * max(1e-3, np.abs(found).max(initial=0.0)))
    )
