"""A plan that is played: a slider over its knots, and what is seen at each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from synergrip.reports.view.drawn import Drawn
from synergrip.reports.view.looks import looks, notes_text, table_of
from synergrip.reports.view.marks import Marks
from synergrip.reports.view.scene import Scene


class Player:
    """A scene on a page, at the instant that its slider says."""

    def __init__(self, server: Any, scene: Scene, notes: Sequence[str] = ()) -> None:
        """Draw the first frame, and put the slider beside it; `server` is a `viser.ViserServer`."""
        self.server, self.scene, gui = server, scene, server.gui
        self.drawn, self.marks = Drawn(server.scene, scene), Marks(server.scene, scene, names=False)
        self.drawn.look(server)
        gui.add_markdown(notes_text(notes))
        last = len(scene.times) - 1
        self.knot = gui.add_slider("knot", 0, max(last, 1), 1, 0, disabled=last == 0)
        self.knot.on_update(lambda _: self.show(int(self.knot.value)))
        self.playing = gui.add_checkbox("play", False, disabled=last == 0)
        self.begun = 0.0
        self.playing.on_update(lambda _: self._begin())
        looks(gui, self.marks)
        with gui.add_folder("Places [mm], palm frame"):
            self.table = gui.add_markdown("")
        self.now = 0.0
        self.show(0)

    def show(self, k: int) -> None:
        """Show a frame."""
        frame = self.scene.frame(min(k, len(self.scene.times) - 1))
        with self.server.atomic():
            self.drawn.show(frame)
            self.marks.show(frame)
            self.table.content = table_of(self.scene, frame)

    def tick(self, now: float) -> None:
        """Go on as far as the clock has, while it plays; `now` in seconds."""
        self.now = now
        if self.playing.value:
            times = self.scene.times - self.scene.times[0]
            span = float(times[-1]) * len(times) / (len(times) - 1)
            self.knot.value = int(np.searchsorted(times, (now - self.begun) % span, side="right") - 1)

    def _begin(self) -> None:
        """Play from where the slider is."""
        self.begun = self.now - float(self.scene.times[int(self.knot.value)] - self.scene.times[0])
