"""``synergrip problems``, ``hands`` and ``schema``: what there is."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from synergrip.cli.running import Format, FormatOption, answering, say, show

if TYPE_CHECKING:
    from synergrip.hands.hand import Hand


def problems(form: FormatOption = Format.TEXT) -> None:
    """List the bundled problems."""
    with answering(form):
        from synergrip.files import bundled
        from synergrip.problems.finding import bundled_problems
        from synergrip.problems.problem_file import read_problem_file
        from synergrip.reports.text.tables import table

        rows = []
        for name in bundled_problems():
            file, _ = read_problem_file(bundled("problems") / f"{name}.toml")
            verdict = (file.expect.verdict if file.expect else None) or ""
            rows.append((name, verdict, file.title))
        keys = ("name", "expected", "title")
        show(form, lambda: table(keys, rows), lambda: {"problems": [dict(zip(keys, r, strict=True)) for r in rows]})


def hands(form: FormatOption = Format.TEXT) -> None:
    """List the bundled hands."""
    with answering(form):
        from synergrip.hands.folder import bundled_hands, load_hand

        loaded = [load_hand(name, relative_to=None) for name in bundled_hands()]
        document = [
            {"name": hand.name, "title": hand.title, "joints": list(hand.joint_names),
             "synergy_sets": {s.name: list(s.synergies) for s in hand.synergy_sets.values()},
             "pads": list(hand.pads), "postures": list(hand.postures)}
            for hand in loaded
        ]  # fmt: skip
        show(form, lambda: "\n\n".join(_text(hand) for hand in loaded), lambda: {"hands": document})


def _text(hand: Hand) -> str:
    """Return a hand with all the names that a problem file may use of it."""
    from synergrip.reports.text.tables import wrapped

    sets = hand.synergy_sets.values()
    parts = {
        "joints": hand.joint_names,
        "synergy sets": [s.name if s.name == "joints" else f"{s.name} ({', '.join(s.synergies)})" for s in sets],
        "postures": hand.postures,
        "pads": hand.pads,
    }
    named = [line for key, names in parts.items() for line in wrapped(f"  {key:14}", ", ".join(names))]
    return "\n".join([*wrapped(f"{hand.name}  ", hand.title), *named])


def schema() -> None:
    """Print the JSON Schema of the problem file, for editors."""
    with answering(Format.TEXT):
        from synergrip.problems.problem_file import problem_schema

        say(json.dumps(problem_schema(), indent=2))
