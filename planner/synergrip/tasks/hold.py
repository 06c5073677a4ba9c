"""The target of a task that moves nothing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.tasks.profiles import Constant
from synergrip.tasks.stated import Motion, Setting


@naming_arguments
@dataclass(frozen=True)
class Hold(Motion):
    """The object stays where it is.

    Example:
        >>> Hold()
        Hold()
    """

    @property
    def kind(self) -> Literal["hold"]:
        """No motion."""
        return "hold"

    def over(self, setting: Setting) -> Constant:
        """Return no columns (T, 0) at any time: there is nothing to follow."""
        return Constant(np.zeros(0))
