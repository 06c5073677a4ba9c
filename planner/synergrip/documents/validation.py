"""From plain values to pydantic models, with every objection translated into an `Issue` of our own words."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import islice
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails, PydanticCustomError

from synergrip.documents.positions import dotted, enclosing
from synergrip.errors import InputError, Issue, one_of, suggest

MOST_JUDGED = 200
"""Issues of a file that are looked at; more than that is another kind of file."""

Value = TypeVar("Value")

LARGEST_NUMBER = 1e100  # products of such numbers stay finite
_WANTED = {
    "string": "a string",
    "int": "a whole number",
    "float": "a number",
    "bool": "true or false",
    "tuple": "a list",
    "list": "a list",
    "dict": "a table",
    "model": "a table",
    "model_attributes": "a table",
}
_BOUNDS = {"greater_than": "greater than", "greater_than_equal": "at least", "less_than_equal": "at most"}


def translate(error: ValidationError, model: type[BaseModel]) -> list[Issue]:
    """Return the issues of a failed validation as a `model`, with keys and without places.

    Of a file written for a newer schema nothing else is said: the rest may mean something else there.
    """
    every = (issue for detail in error.errors(include_url=False) for issue in _issues(detail, model))
    found = list(islice(every, MOST_JUDGED))
    newer = [issue for issue in found if issue.key == "schema" and "upgrade" in issue.message]
    return newer or [issue for issue in found if not _explained(issue, found)]


def refusing(check: Callable[[Any], Value]) -> Callable[[Any], Value]:
    """Return `check` for use inside a model: its `InputError` joins the other issues of the file.

    The keys of its issues are relative to the value that is checked.
    """

    def checked(value: Any) -> Value:
        try:
            return check(value)
        except InputError as error:
            raise PydanticCustomError("issues", "see issues", {"issues": error.issues}) from None

    return checked


def shown(value: object) -> str:
    """Return a value as it looks in a message: short, and in the words of TOML and JSON."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if value is None:
        return "null"
    if isinstance(value, Mapping):
        return "a table"
    if isinstance(value, list | tuple):
        return "a list"
    text = repr(value)
    return text if len(text) <= 40 else f"{text[:37]}..."


def _explained(issue: Issue, found: Sequence[Issue]) -> bool:
    """Tell whether a missing key is there under a misspelled name, or a missing entry is one that was refused."""
    if issue.message.startswith("expected at least"):
        return any(other.key.startswith(f"{issue.key}[") for other in found)
    name = issue.key[len(enclosing(issue.key)) :].lstrip(".")
    return issue.message.startswith("missing key") and any(
        other.message.endswith(f"did you mean '{name}'?") and enclosing(other.key) == enclosing(issue.key)
        for other in found
    )


def _issues(detail: ErrorDetails, model: type[BaseModel]) -> Iterator[Issue]:
    key, kind = dotted(detail["loc"]), detail["type"]
    context = detail.get("ctx", {})
    if kind == "issues":
        for issue in context["issues"]:
            separator = "" if not key or not issue.key or issue.key.startswith("[") else "."
            yield Issue(issue.message, key=f"{key}{separator}{issue.key}", on_key=issue.on_key)
    elif kind == "extra_forbidden":
        name = str(detail["loc"][-1])
        known = _fields(_model_at(model, detail["loc"][:-1]))
        hint = suggest(name, known) or (f"; known keys: {', '.join(known)}" if known else "")
        yield Issue(f"unknown key '{name}'{hint}", key=key, on_key=True)
    elif kind == "missing":
        name = str(detail["loc"][-1])
        field = _fields(_model_at(model, detail["loc"][:-1])).get(name)
        meaning = f" ({field.description})" if field and field.description else ""
        yield Issue(f"missing key '{name}'{meaning}", key=key, on_key=True)
    else:
        advice = ""
        if kind == "tuple_type" and isinstance(detail["input"], Mapping) and _model_at(model, detail["loc"]):
            advice = f"; its entries are written [[{key}]] in TOML, --set {key}=[{{...}}] gives all of them"
        yield Issue(_message(kind, detail["input"], context) + advice, key=key)


def _message(kind: str, value: object, context: Mapping[str, Any]) -> str:
    if kind == "literal_error":
        valid = re.findall(r"'([^']*)'", str(context["expected"]))
        return one_of(value, valid) if isinstance(value, str) and valid else _expected(value, context["expected"])
    if kind in _BOUNDS:
        return f"must be {_BOUNDS[kind]} {next(iter(context.values())):g}, got {shown(value)}"
    if kind in ("too_short", "too_long"):
        few = kind == "too_short"
        limit = context["min_length" if few else "max_length"]
        bound = f"{'least' if few else 'most'} {limit} entr{'y' if limit == 1 else 'ies'}"
        return f"expected at {bound}, got {context['actual_length']}"
    if kind == "string_unicode":
        return f"expected text, got {shown(value)}, in which a character is cut in half"
    if kind == "string_too_short":
        return "must not be empty"
    return _expected(value, _WANTED.get(kind.removesuffix("_type").removesuffix("_parsing"), "another value"))


def _expected(value: object, wanted: object) -> str:
    return f"expected {wanted}, got {shown(value)}"


def _model_at(model: type[BaseModel] | None, path: Sequence[str | int]) -> type[BaseModel] | None:
    for part in path:
        if isinstance(part, str) and model is not None:
            field = _fields(model).get(part)
            model = next(_models(field.annotation), None) if field else None
    return model


def _models(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for inner in get_args(annotation):
        yield from _models(inner)


def _fields(model: type[BaseModel] | None) -> dict[str, FieldInfo]:
    return {field.alias or name: field for name, field in model.model_fields.items()} if model else {}
