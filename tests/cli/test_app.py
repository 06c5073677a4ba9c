"""Verbs got ready one by one: the same command line, without what nobody asks for."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from typer.core import TyperGroup
from typer.main import get_command

from synergrip.cli.app import VERBS, app, app_for


@pytest.mark.parametrize("verb", VERBS, ids=lambda verb: verb.__name__)
def test_a_verb_is_got_ready_by_itself(verb: Callable[..., None]) -> None:
    made = get_command(app_for([verb.__name__, "pinch-soft", "--help"]))
    assert isinstance(made, TyperGroup)
    assert list(made.commands) == [verb.__name__]
    whole = get_command(app)
    assert isinstance(whole, TyperGroup)
    assert [each.name for each in made.params] == [each.name for each in whole.params]
    alone, among = ([each.opts for each in group.commands[verb.__name__].params] for group in (made, whole))
    assert alone == among


@pytest.mark.parametrize("words", [[], ["--help"], ["plann"], ["synergies", "list"], ["-h", "plan"]])
def test_any_other_words_get_all_verbs_ready(words: list[str]) -> None:
    assert app_for(words) is app
