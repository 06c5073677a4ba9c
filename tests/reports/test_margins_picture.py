"""The picture of margins: forces inside their cones, one colour per contact, a file that is written or refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from command_line import run

from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.contacts.elliptic_soft_finger import EllipticSoftFinger
from synergrip.grasps.contacts.frictionless import Frictionless
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.contacts.soft_finger import SoftFinger
from synergrip.reports.pictures.cone_sections import used_friction, when_worst
from synergrip.reports.pictures.contact_colors import COLORS, contact_colors


def contact(kind: ContactKind) -> Contact:
    return Contact(name="thumb", kind=kind, point=np.zeros(3), frame=np.eye(3))


def test_the_share_of_friction_is_where_the_force_points() -> None:
    used = used_friction(contact(HardFinger(friction=0.5)), np.array([[4.0, 1.0, 0.0], [4.0, 0.0, -2.0]]))
    assert used == pytest.approx(np.array([[0.5, 0.0], [0.0, -1.0]]))


def test_spin_takes_its_share_and_without_a_tangent_has_no_direction_of_its_own() -> None:
    soft = contact(SoftFinger(friction=0.5, spin_friction=0.01))
    used = used_friction(soft, np.array([[4.0, 0.6, 0.8, 0.0], [4.0, 0.6, 0.8, 0.04], [4.0, 0.0, 0.0, 0.02]]))
    assert used is not None
    assert np.linalg.norm(used, axis=1) == pytest.approx([0.5, np.hypot(0.5, 1.0), 0.5])
    assert used[0] == pytest.approx([0.3, 0.4])


def test_what_is_outside_its_cone_is_drawn_a_little_outside() -> None:
    elliptic = contact(EllipticSoftFinger(friction=0.5, cross_friction=0.25, spin_friction=0.01))
    used = used_friction(elliptic, np.array([[4.0, 0.0, 0.5, 0.0], [4.0, 0.0, 9.0, 0.0], [-1.0, 0.0, 0.1, 0.0]]))
    assert used == pytest.approx(np.array([[0.0, 0.5], [0.0, 1.2], [0.0, 1.2]]))


def test_a_contact_without_friction_has_no_cross_section() -> None:
    assert used_friction(contact(Frictionless()), np.array([[1.0]])) is None


def test_rounding_does_not_say_when_a_margin_is_least() -> None:
    assert when_worst(np.array([1.0, 0.2 + 1e-9, 0.2, 0.5])) == 1


def test_every_contact_has_a_colour_and_the_first_eight_one_of_their_own() -> None:
    names = [f"C{k}" for k in range(10)]
    colors = contact_colors(names)
    assert len({colors[name] for name in names[:8]}) == 8
    assert colors["C8"] == COLORS[0]


def test_the_picture_is_written_and_told(tmp_path: Path) -> None:
    file = tmp_path / "margins.svg"
    done = run("margins", "tripod", "--only", "disturbance", "--only", "sensitivities", "--picture", str(file))
    assert done.exit_code == 0
    assert f"wrote {file}" in " ".join(done.stdout.split())
    drawn = file.read_text(encoding="utf-8")
    told = ("smallest slip margin 7 N", "Slip margin of each contact", "friction cone", "Extra force", "force cap +1 %")
    for text in (*told, *COLORS[:3]):
        assert text in drawn


def test_a_picture_of_no_format_is_refused_before_anything_is_planned(tmp_path: Path) -> None:
    done = run("margins", "tripod", "--picture", str(tmp_path / "margins.txt"))
    assert done.exit_code == 2
    assert ".svg" in done.stderr
