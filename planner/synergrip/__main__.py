"""``python -m synergrip`` is the command line."""

from synergrip.cli import main

if __name__ == "__main__":
    main()
