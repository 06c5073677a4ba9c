"""The 3-D view of an answer inside a notebook."""

from __future__ import annotations

from dataclasses import dataclass, field
from html import escape
from pathlib import Path

from synergrip.errors import InputError
from synergrip.files import atomic_path
from synergrip.reports.data.saving import path_of, written_at
from synergrip.reports.libraries import refuse_without
from synergrip.reports.view.scene import Scene

LOWEST, HIGHEST = 50, 10_000
"""[pixels]"""


@dataclass(frozen=True)
class Viewer:
    """A page that plays a hand; a notebook shows it where it is returned, and no network is needed."""

    page: str = field(repr=False)
    """HTML."""
    height: int  # [pixels]
    told: str
    """What is seen, in a few words."""

    def __repr__(self) -> str:
        """Return what is seen, and how."""
        return f'<Viewer: {self.told}; a notebook shows it, .save("view.html") writes it>'

    def _repr_html_(self) -> str:
        """Return the page in a frame of its own."""
        style = f"width: 100%; height: {self.height}px; border: 0"
        return f'<iframe title="3-D view" style="{style}" srcdoc="{escape(self.page)}"></iframe>'

    def save(self, path: str | Path) -> Path:
        """Write the page into a file that opens offline, and return it.

        Raises:
            InputError: no path of a file.
            OutputError: it cannot be written.
        """
        place = path_of(path, "path")
        written_at("path", place, lambda: self._write(place))
        return place

    def _write(self, place: Path) -> None:
        with atomic_path(place) as temporary:
            temporary.write_text(self.page, encoding="utf-8")


def viewer_of(scene: Scene, height: int) -> Viewer:
    """Return the view of a scene.

    Raises:
        InputError: viser is not installed, or a height that is none.
    """
    if isinstance(height, bool) or not isinstance(height, int) or not LOWEST <= height <= HIGHEST:
        raise InputError.at("height", f"expected a whole number of pixels from {LOWEST} to {HIGHEST}, got {height!r}")
    refuse_without({"viser": "viser"}, "viewer")
    from synergrip.reports.view.drawn import page

    frames, contacts = len(scene.times), len(scene.contacts)
    told = f"{frames} frame{'s' * (frames != 1)} of a hand with {contacts} contact{'s' * (contacts != 1)}"
    return Viewer(page(scene), height, told)
