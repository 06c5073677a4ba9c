"""Where labels stand in a view so that none is over another, seen from where the view begins."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.linalg import Array

HIGH, WIDE = 0.04, 0.0135
"""Height of a label, and width of a letter of it, in distances of the camera: of some 24 and 8 pixels in 900."""


def apart(places: Array, texts: Sequence[str], camera: tuple[Array, Array], up: Array) -> Array:
    """Return places (n, 3) of labels, each lowered on the screen until it is over none of the others.

    Args:
        places: (n, 3) the upper left corners.
        texts: what stands on each.
        camera: where it is, and at what it looks.
        up: (3,) what is up on the screen, or nearly so.
    """
    look = camera[1] - camera[0]
    far = float(np.linalg.norm(look))
    right = np.cross(look, up)
    right /= max(float(np.linalg.norm(right)), 1e-12)
    upward = np.cross(right, look) / max(far, 1e-12)
    left, top = places @ right, places @ upward
    wide, high = np.array([WIDE * far * len(text) for text in texts]), HIGH * far
    lowered, done = np.array(top), list[int]()
    for label in np.argsort(-top, kind="stable").tolist():
        beside = [i for i in done if left[i] < left[label] + wide[label] and left[label] < left[i] + wide[i]]
        for other in sorted(beside, key=lambda i: -lowered[i]):
            if abs(lowered[label] - lowered[other]) < high:
                lowered[label] = lowered[other] - high
        done.append(label)
    return np.asarray(places + (lowered - top)[:, None] * upward)
