"""The command line: verbs, and nothing else. Mathematics and heavy imports live behind them."""

from __future__ import annotations

import io
import sys
import traceback


def main() -> None:
    """Run the command line; what is not foreseen leaves with exit code 4, never with 1 (proven infeasible)."""
    from synergrip.cli.app import app

    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # a terminal that cannot show Γ is no reason to fail
    try:
        app()
    except Exception:
        traceback.print_exc()
        print("synergrip: this is a defect of synergrip; please report it with the problem file.", file=sys.stderr)
        sys.exit(4)
