"""The command line: verbs, and nothing else. Mathematics and heavy imports live behind them."""

from __future__ import annotations

import gc
import os
import sys

from synergrip.cli import ending

OBJECTS = 20_000
"""New objects after which Python looks for garbage. What is imported stays, and looking through it after every 700
objects, as is usual, takes a tenth of a short command."""


def main() -> None:
    """Run the command line: from here on it hears the signals of this process, and its streams are guarded.

    What is not foreseen leaves with exit code 4, never with 1 (proven infeasible).
    """
    ending.watch()
    gc.set_threshold(OBJECTS)
    os.environ.setdefault("MUJOCO_GL", "disable")  # nothing is drawn with MuJoCo here; it need not look for a screen
    try:
        from synergrip.cli.streams import PrintError, guard

        guard()
        from synergrip.cli.app import app_for

        try:
            try:
                app_for(sys.argv[1:])()
            except SystemExit as left:
                sys.stdout.flush()
                ending.end(left.code)
                gc.freeze()  # all of it goes with the process: not looked through for garbage first
                raise
        except PrintError as error:  # of the help or the version
            print(f"error: {error}      exit code {error.exit_code}", file=sys.stderr)
            sys.exit(error.exit_code)
    except Exception:
        import traceback

        traceback.print_exc()
        print("synergrip: this is a defect of synergrip; please report it with the problem file.", file=sys.stderr)
        sys.exit(4)
