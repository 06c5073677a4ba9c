"""Writes the Python code of README.md and docs into one file for each page, for a type checker to read.

Usage: python tests/code_of_pages.py FOLDER
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
PYTHON = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)


def write(folder: Path) -> list[Path]:
    """Write one file for each page that has code, and return them."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))):
        if code := PYTHON.findall(page.read_text(encoding="utf-8")):
            name = "_".join(page.relative_to(ROOT).with_suffix("").parts).replace("-", "_").lower()
            file = folder / f"{name}_page.py"
            file.write_text("\n".join(code), encoding="utf-8")
            written.append(file)
    return written


if __name__ == "__main__":
    print(*write(Path(sys.argv[1])), sep="\n")
