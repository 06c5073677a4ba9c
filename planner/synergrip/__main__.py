"""``python -m synergrip`` is the command line."""

import sys

if __name__ == "__main__":
    try:
        from synergrip.cli import main
    except KeyboardInterrupt:  # it does not hear of it by itself yet
        print("interrupted; nothing was written", file=sys.stderr)
        sys.exit(130)
    main()
