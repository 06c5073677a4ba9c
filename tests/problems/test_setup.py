"""From the tables [hand], [object] and [contacts] to a grasp: links, turned objects, hands that close, and notes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.grasps.held import Held
from synergrip.problems.problem import Problem, load_problem

NAME = "barrett-ball-hold"
PLACE = "object.position=['0 mm', '3.3453861801217856 mm', '148.83719359293873 mm']"
OPEN = ("hand.posture=open", PLACE)


def held(problem: Problem) -> Held:
    assert problem.held is not None
    return problem.held


def refused(*overrides: str) -> list[tuple[str, str]]:
    with pytest.raises(InputError) as caught:
        load_problem(NAME, overrides)
    return [(issue.key, issue.message) for issue in caught.value.issues]


def on_links(*entries: str) -> str:
    return f"contact=[{', '.join(entries)}]"


CURLED = ("hand.posture=open", "object.position=['0 mm', '10 mm', '130 mm']", "hand.close=close")
NO_PADS = "contacts={model='hard', friction=0.6, stiffness='8 N/mm'}"


def test_a_place_on_a_link_is_as_good_as_a_pad() -> None:
    """Pad finger1/pad is at (50.99, -0.18, 0) mm of the outer link and pushes along y."""
    ball = "object.shape={sphere={radius='52 mm'}}"
    by_pad = load_problem(NAME, [ball, *CURLED, "contacts.at=['finger1/pad', 'finger2/pad', 'finger3/pad']"])
    entry = "{{name='finger{0}/pad', link='finger{0}_outer_link', point=['50.99 mm', '-0.18 mm', '0 mm'], normal='y'}}"
    by_link = load_problem(NAME, [ball, *CURLED, NO_PADS, on_links(*(entry.format(i) for i in (1, 2, 3)))])
    assert np.array_equal(by_pad.grasp.G, by_link.grasp.G)
    assert np.array_equal(by_pad.grasp.J, by_link.grasp.J)
    assert np.array_equal(held(by_pad).body.position, held(by_link).body.position)
    assert [c.name for c in by_link.grasp.contacts] == ["finger1/pad", "finger2/pad", "finger3/pad"]


def test_a_link_without_point_and_normal_touches_with_its_origin_toward_the_object() -> None:
    """The fingertip links have their origins where the pads are."""
    by_pad = load_problem(NAME, [PLACE])
    by_link = load_problem(NAME, [PLACE, NO_PADS, on_links(*(f"{{link='finger{i}_tip'}}" for i in (1, 2, 3)))])
    assert np.allclose(by_pad.grasp.G, by_link.grasp.G, atol=1e-15)
    assert np.allclose(by_pad.grasp.J, by_link.grasp.J, atol=1e-15)
    assert [c.name for c in by_link.grasp.contacts] == ["finger1_tip", "finger2_tip", "finger3_tip"]
    assert [touch.aimed for touch in held(by_link).touches] == [False] * 3


def test_a_ball_that_nobody_pushes_needs_a_position() -> None:
    found = refused(NO_PADS, on_links(*(f"{{link='finger{i}_tip'}}" for i in (1, 2, 3))))
    assert [key for key, _ in found] == ["object.position"]


def test_round_places_on_links_move_the_ball_away_by_their_radius() -> None:
    """The pads are as far from the centre as ball and round pad together."""
    entry = "{{link='finger{}_tip', normal='z', radius='4 mm'}}"
    body = held(load_problem(NAME, [NO_PADS, on_links(*(entry.format(i) for i in (1, 2, 3)))])).body
    for motion in held(load_problem(NAME)).hand.kinematics.at(
        held(load_problem(NAME)).q, [(f"finger{i}_tip", np.zeros(3)) for i in (1, 2, 3)]
    ):
        assert np.linalg.norm(motion.position - body.position) == pytest.approx(0.054, abs=1e-12)


def test_links_and_pads_that_the_hand_does_not_have_are_refused_together() -> None:
    found = refused("hand.close=clsoe", "contacts.at=['finger1/tpi']", on_links("{link='finger2_tpi'}"))
    assert [key for key, _ in found] == ["hand.close", "contacts.at[0]", "contact[0].link", "object.position"]
    assert "did you mean 'finger1/tip'?" in found[1][1]
    assert "link 'finger2_tpi' is not one of 'palm', 'finger1_base'" in found[2][1]
    assert "did you mean 'finger2_tip'?" in found[2][1]


@pytest.mark.parametrize("close", ["close", "{close=2}", "{finger1=1, finger2=1, finger3=0.9}"])
def test_a_hand_that_closes_ends_in_the_posture_that_ships(close: str) -> None:
    shipped, closed = load_problem(NAME), load_problem(NAME, [*OPEN, f"hand.close={close}"])
    assert held(closed).q == pytest.approx(held(shipped).q, abs=1e-9)
    assert held(closed).gaps == pytest.approx([0, 0, 0], abs=1e-9)
    for one, other in ((closed.grasp.J, shipped.grasp.J), (closed.grasp.G, shipped.grasp.G)):
        assert one == pytest.approx(other, abs=1e-9)


def test_synergies_of_a_chosen_set_close_the_hand() -> None:
    closed = load_problem(NAME, [*OPEN, "hand.synergies=close", "hand.close={spread=0, close=1}"])
    assert held(closed).q == pytest.approx(held(load_problem(NAME)).q, abs=1e-9)


@pytest.mark.parametrize(
    ("overrides", "keys"),
    [
        (("hand.close=close",), ["object.position"]),
        (("hand.close=close", "object={mass='1 g'}"), ["object.shape", "object.position"]),
        ((*OPEN, "hand.close=spread"), ["contacts.at[1]", "contacts.at[2]"]),
        ((*OPEN, "hand.close=-close"), ["contacts.at[0]", "contacts.at[1]", "contacts.at[2]"]),
        ((PLACE, "hand.close=close", "hand.posture={finger1='80 deg'}"), ["contacts.at[0]"]),
    ],
)
def test_hands_that_cannot_close_are_refused(overrides: tuple[str, ...], keys: list[str]) -> None:
    assert [key for key, _ in refused(*overrides)] == keys


def test_a_turned_box_is_touched_on_its_turned_face() -> None:
    """Two fingertips beside each other lean on a plate; turned by 90 deg about y its thickness lies along z."""
    tips = held(load_problem(NAME)).hand.kinematics.at(
        held(load_problem(NAME)).q, [(f"finger{i}_tip", np.zeros(3)) for i in (2, 3)]
    )
    height = 1e3 * float(tips[0].position[2])
    at = f"object.position=['0 mm', '0 mm', '{height - 5!r} mm']"
    plate = "object.shape={box={size=['10 mm', '200 mm', '200 mm']}}"
    tips_only = [NO_PADS, on_links("{link='finger2_tip'}", "{link='finger3_tip'}"), at, plate]
    turned = load_problem(NAME, [*tips_only, "object.orientation={axis='y', angle='90 deg'}"])
    assert held(turned).gaps == pytest.approx([0, 0], abs=1e-9)
    for contact in turned.grasp.contacts:
        assert contact.frame[:, 0] == pytest.approx([0, 0, -1], abs=1e-12)
    assert [key for key, _ in refused(*tips_only)] == ["contact[0].link", "contact[1].link"]


def test_a_turned_ball_is_the_ball() -> None:
    turned = load_problem(NAME, ["object.orientation={axis=[1, 2, 3], angle='40 deg'}"])
    assert np.array_equal(turned.grasp.G, load_problem(NAME).grasp.G)


def test_a_stiffness_that_is_missing_is_found_at_its_link(tmp_path: Path) -> None:
    """A rigid contact with rigid joints is refused at the entry of the link."""
    from synergrip.errors import SynergripError
    from synergrip.planning.planning import plan
    from synergrip.problems.problem import located

    entries = [f"{{link='finger{i}_tip', stiffness='rigid'}}" for i in (1, 2, 3)]
    overrides = [PLACE, "contacts={friction=0.6}", on_links(*entries), "hand.compliance={joint='0 rad/(N m)'}"]
    problem = load_problem(NAME, overrides)
    with pytest.raises(SynergripError) as caught:
        plan(problem.grasp, problem.task)
    assert "contact[0].stiffness" in str(located(problem, caught.value))


# Notes


def test_the_shipped_grasps_give_no_reason_for_a_note() -> None:
    for name in (NAME, "table2-hard-motors", "tripod", "pinch-soft"):
        assert load_problem(name).notes == ()


def test_links_inside_the_object_are_noted() -> None:
    problem = load_problem(NAME, ["hand.posture=open", "hand.close=close", "object.position=['0 m', '3 mm', '109 mm']"])
    (note,) = problem.notes
    assert note.startswith("the hand may collide with the ball r 50 mm: its skeleton runs inside on the line from")


@pytest.mark.parametrize(("apart", "noted"), [(0.0, True), (0.9e-4, True), (1.1e-4, False), (None, False)])
def test_points_of_a_grasp_file_on_the_same_spot_are_noted(tmp_path: Path, apart: float | None, noted: bool) -> None:
    data = json.loads((Path(load_problem("tripod").path).parent / "tripod.json").read_text())
    for contact in data["contacts"]:
        contact.pop("point_m", None)
    G = np.array(data["G"])
    offset = np.array([0.0, 0.0, apart or 0.0])
    first = np.array([1.0, 2.0, 3.0])
    G[:3, 3:6] = G[:3, 0:3]
    for start, point in ((0, first), (3, first + offset)):
        G[3:, start : start + 3] = np.column_stack([np.cross(point, f) for f in G[:3, start : start + 3].T])
        if apart is not None:
            data["contacts"][start // 3]["point_m"] = point.tolist()
        data["contacts"][start // 3].pop("normal", None)
    data["G"] = G.tolist()
    (tmp_path / "grasp.json").write_text(json.dumps(data))
    notes = load_problem(tmp_path / "grasp.json").notes
    names = [contact["name"] for contact in data["contacts"]]
    about = f"contacts '{names[0]}' and '{names[1]}' are on the same spot, {1e3 * (apart or 0):.2g} mm apart"
    assert notes == ((about,) if noted else ())
