"""The code of docs/many.md runs and prints what the page shows."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path

from test_in_code import judge

TEXT = (Path(__file__).parents[2] / "docs" / "many.md").read_text(encoding="utf-8")


def test_the_page_prints_what_it_shows() -> None:
    (code,) = re.findall(r"^```python\n(.*?)^```", TEXT, re.DOTALL | re.MULTILINE)
    (shown,) = re.findall(r"^```text\n(.*?)^```", TEXT, re.DOTALL | re.MULTILINE)
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(code, "many.md", "exec"), {"__name__": "page"})
    judge(printed.getvalue(), shown)
