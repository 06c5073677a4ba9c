"""``synergrip problems``, ``hands`` and ``schema``: what there is."""

from __future__ import annotations

import json

from synergrip.cli.running import Format, FormatOption, answering, say, show


def problems(form: FormatOption = Format.TEXT) -> None:
    """List the bundled problems."""
    with answering(form):
        from synergrip.files import bundled
        from synergrip.plans.problem import bundled_problems
        from synergrip.plans.problem_file import read_problem_file
        from synergrip.reports.tables import table

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
        from synergrip.reports.tables import table

        loaded = [load_hand(name, relative_to=None) for name in bundled_hands()]
        rows = [
            (hand.name, str(len(hand.joints)),
             ", ".join(f"{s.name} ({s.S.shape[1]})" for s in hand.synergy_sets.values()),
             ", ".join(hand.pads), ", ".join(hand.postures), hand.title)
            for hand in loaded
        ]  # fmt: skip
        keys = ("name", "joints", "synergy sets", "pads", "postures", "title")
        document = [
            {"name": hand.name, "title": hand.title, "joints": list(hand.joint_names),
             "synergy_sets": {s.name: list(s.synergies) for s in hand.synergy_sets.values()},
             "pads": list(hand.pads), "postures": list(hand.postures)}
            for hand in loaded
        ]  # fmt: skip
        show(form, lambda: table(keys, rows), lambda: {"hands": document})


def schema() -> None:
    """Print the JSON Schema of the problem file, for editors."""
    with answering(Format.TEXT):
        from synergrip.plans.problem_file import problem_schema

        say(json.dumps(problem_schema(), indent=2))
