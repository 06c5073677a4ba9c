"""What the library tells while it works, to whoever listens: the logger "synergrip" of the standard library.

Stages of planning are told at INFO, attempts and changes of units at DEBUG. Nothing is printed unless a program asks:

    logging.basicConfig(level=logging.INFO)
"""

from __future__ import annotations

import logging

LOG = logging.getLogger("synergrip")
LOG.addHandler(logging.NullHandler())
LONG = LOG.getChild("long")
"""What takes seconds, as it begins: the command line tells it; at DEBUG where it does so only with what came before."""
