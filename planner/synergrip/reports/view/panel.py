"""The panel of a hand that is posed by its user: dials for joints, synergies and the object, and a table of places."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from synergrip.errors import InputError
from synergrip.hands.hand import SynergySet
from synergrip.linalg import Array
from synergrip.reports.view.drawn import Drawn
from synergrip.reports.view.looks import headline, looks, notes_text, table_of
from synergrip.reports.view.marks import Marks
from synergrip.reports.view.posed import Posed
from synergrip.reports.view.posing import Dial, Posing, posture_line

STEP = 0.1
"""[deg or mm] of a dial."""
ROOM = 0.3
"""[m] How far the object is moved along each axis from where it is at the start."""
BEGUN = "as it began"
"""The first of the postures that can be chosen."""
NOTED = " · see Notes below"
Change = Callable[[Posing, int, float], Posing]


class Panel:
    """A hand that is posed by the dials of a page; `posing` is what they say."""

    def __init__(
        self, server: Any, posed: Posed, posing: Posing, *, sets: Mapping[str, SynergySet],
        closed: Callable[[Array], Array] | None = None, title: str = "", notes: Sequence[str] = (),
    ) -> None:  # fmt: skip
        """Draw the hand, and put dials beside it.

        Args:
            server: `viser.ViserServer`.
            posed: the hand and what it is to hold.
            posing: where it begins.
            sets: the synergy sets that can be turned, by name; none where all that can be turned are joints.
            closed: the posture (n_q,) in which the hand has closed on the object at a position (3,), or an error.
            title: what is said above the dials.
            notes: what is said below them.
        """
        self.posed, self.begin, self.posing, self.sets, self.closed = posed, posing, posing, sets, closed
        self.lock, self.server, gui = threading.RLock(), server, server.gui
        scene = posed.scene(posing.q, posing.position)
        self.drawn, self.marks = Drawn(server.scene, scene), Marks(server.scene, scene, names=not posed.touches)
        self.drawn.look(server)
        self.said = gui.add_markdown(headline(title + (NOTED if notes else "")))
        self._whole(gui)
        self.synergies: list[Any] = []
        if sets:
            with gui.add_folder("Synergies (from where it began)") as self.folder:
                self._choice(gui)
                self.synergies = self._synergies(gui)
        with gui.add_folder("Joints"):
            self.joints = [self._dial(gui, dial, Posing.with_joint, i) for i, dial in enumerate(posing.joint_dials())]
            self.posture = gui.add_markdown("")
        self.axes: list[Any] = []
        self.line: Any = None
        if posed.body is not None:
            self.axes, self.line = self._object(gui)
        looks(gui, self.marks)
        with gui.add_folder("Places [mm], palm frame"):
            self.table = gui.add_markdown("")
        if notes:
            with gui.add_folder("Notes"):
                gui.add_markdown(notes_text(notes))
        self.show()

    def change(self, make: Callable[[Posing], Posing]) -> None:
        """Pose the hand otherwise, and show it."""
        with self.lock:
            self.posing = make(self.posing)
            self.show()

    def show(self) -> None:
        """Draw the hand as it is posed, and turn the dials to where it is."""
        posing = self.posing
        frame = self.posed.frame(posing.q, posing.position)
        with self.server.atomic():
            self.drawn.show(frame)
            self.marks.show(frame)
            _turn(self.synergies, posing.synergy_dials() if self.synergies else [])
            _turn(self.joints, posing.joint_dials())
            _turn(self.axes, self._axis_dials() if self.axes else [])
            self.table.content = table_of(self.drawn.scene, frame)
            self.posture.content = f"`{posture_line(posing)}`"
            if self.line is not None:
                self.line.content = f"`{_position(posing.position)}`"

    def _whole(self, gui: Any) -> None:
        """Add what poses the whole hand."""
        gui.add_button("Reset").on_click(lambda _: self.change(lambda posing: self.begin.with_set(posing.synergies)))
        postures = self.posed.hand.postures
        chosen = gui.add_dropdown("posture", [BEGUN, *postures])

        def take(event: Any) -> None:
            q = postures.get(chosen.value, self.begin.q)
            if event.client is not None:
                self.change(lambda posing: posing.with_posture(q))

        chosen.on_update(take)
        if self.closed is not None:
            gui.add_button("Close on the object").on_click(lambda _: self._close(self.closed))

    def _close(self, closed: Callable[[Array], Array] | None) -> None:
        assert closed is not None
        try:
            q = closed(self.posing.position)
        except InputError as error:
            self.said.content = notes_text([issue.message for issue in error.issues])
            return
        self.said.content = ""
        self.change(lambda posing: posing.with_posture(q))

    def _choice(self, gui: Any) -> None:
        """Add the choice of a synergy set, where there is one."""
        if len(self.sets) < 2:
            return
        name = next((name for name, each in self.sets.items() if each is self.posing.synergies), next(iter(self.sets)))
        choice = gui.add_dropdown("set", list(self.sets), initial_value=name)

        def other(event: Any) -> None:
            if event.client is None:
                return
            with self.lock, self.folder:
                for handle in self.synergies:
                    handle.remove()
                self.posing = self.posing.with_set(self.sets[choice.value])
                self.synergies = self._synergies(gui)
                self.show()

        choice.on_update(other)

    def _synergies(self, gui: Any) -> list[Any]:
        """Add the dials of the synergies."""
        return [self._dial(gui, dial, Posing.with_synergy, i) for i, dial in enumerate(self.posing.synergy_dials())]

    def _object(self, gui: Any) -> tuple[list[Any], Any]:
        """Add what moves the object, and the line of the problem file that puts it there."""
        with gui.add_folder("Object"):
            handles = [self._dial(gui, each, Posing.with_position, i) for i, each in enumerate(self._axis_dials())]
            return handles, gui.add_markdown("")

    def _axis_dials(self) -> list[Dial]:
        begun, now = self.begin.position, self.posing.position
        return [Dial(axis, "mm", 1e3, float(a) - ROOM, float(a) + ROOM, float(b))
                for axis, a, b in zip("xyz", begun, now, strict=True)]  # fmt: skip

    def _dial(self, gui: Any, dial: Dial, change: Change, index: int) -> Any:
        """Add a dial that changes the posing by the number of what it turns."""
        low, high, value = (_shown(dial, each) for each in (dial.lower, dial.upper, dial.value))
        handle = gui.add_slider(
            f"{dial.name} [{dial.unit}]", low, max(high, low + STEP), STEP, min(max(value, low), high),
            disabled=dial.follows or not high > low,
        )  # fmt: skip

        def turned(event: Any) -> None:
            if event.client is not None:  # by somebody, not by `show`
                self.change(lambda posing: change(posing, index, float(handle.value) / dial.factor))

        handle.on_update(turned)
        return handle


def _turn(handles: Sequence[Any], dials: Sequence[Dial]) -> None:
    """Turn dials to where they are; what somebody turns is not turned back by less than a step."""
    for handle, dial in zip(handles, dials, strict=True):
        value = min(max(_shown(dial, dial.value), handle.min), handle.max)
        if abs(handle.value - value) > STEP / 2:
            handle.value = value


def _shown(dial: Dial, value: float) -> float:
    return round(dial.factor * value, 1) + 0.0


def _position(position: Array) -> str:
    return "position = [" + ", ".join(f'"{round(1e3 * float(value), 1) + 0.0:g} mm"' for value in position) + "]"
