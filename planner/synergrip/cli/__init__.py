"""The command line: verbs, and nothing else. Mathematics and heavy imports live behind them."""

from __future__ import annotations

import os
import sys

from synergrip.cli import ending


def main() -> None:
    """Run the command line: from here on it hears the signals of this process, and its streams are guarded.

    What is not foreseen leaves with exit code 4, never with 1 (proven infeasible).
    """
    ending.watch()
    os.environ.setdefault("MUJOCO_GL", "disable")  # nothing is drawn with MuJoCo here; it need not look for a screen
    try:
        from synergrip.cli.streams import PrintError, guard

        guard()
        from synergrip.cli.app import app

        try:
            try:
                app()
            except SystemExit as left:
                sys.stdout.flush()
                ending.end(left.code)
                raise
        except PrintError as error:  # of the help or the version
            print(f"error: {error}      exit code {error.exit_code}", file=sys.stderr)
            sys.exit(error.exit_code)
    except Exception:
        import traceback

        traceback.print_exc()
        print("synergrip: this is a defect of synergrip; please report it with the problem file.", file=sys.stderr)
        sys.exit(4)
