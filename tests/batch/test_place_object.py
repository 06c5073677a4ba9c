"""The place of an object is the best one: no place nearby, and none at random, has a larger margin."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import synergrip as sg
from synergrip.batch import best_place, place_judge, planned_places
from synergrip.batch.judged_places import JudgedPlaces
from synergrip.batch.place_judge import PlaceJudge
from synergrip.batch.placed_object import position_line
from synergrip.batch.planned_places import Candidate, first_clauses, first_that_holds
from synergrip.grasps import place_search
from synergrip.grasps.asked_grasp import asked_grasp, grasp_of
from synergrip.grasps.closing_at_many import Closer
from synergrip.grasps.place_search import TouchingPlaces, touching_places
from synergrip.planning.planning import plan_of_start_posture

TIPS = [f"finger{i}/tip" for i in (1, 2, 3)]
CONTACTS = [sg.ContactAt(tip, sg.HardFinger(friction=0.6), stiffness=8e3) for tip in TIPS]
BALL = sg.Object(mass=0.2, shape=sg.Sphere(radius=0.05))
TASK = sg.Task(loads=[sg.Gravity((0, 0, -9.81))], limits=[sg.NormalForce(upper=20.0)])


def placed(task: sg.Task = TASK, ball: sg.Object = BALL) -> sg.PlacedObject:
    return sg.place_object("barrett", ball, posture="open", close="close", contacts=CONTACTS, task=task)


def margin_at(position: np.ndarray) -> float:
    """Return the largest margin with the object at a place, by `plan`; nan where it is not touched or not held."""
    try:
        grasp = sg.make_grasp("barrett", replace(BALL, position=position), posture="open", close="close",
                              contacts=CONTACTS)  # fmt: skip
    except sg.InputError:
        return float("nan")
    answer = plan_of_start_posture(grasp, TASK.replace(knots=1, linearise="once", goals=[sg.LargestMargin()]))
    return float(answer.margins.min()) if isinstance(answer, sg.Plan) else float("nan")


@pytest.fixture
def coarse(monkeypatch: pytest.MonkeyPatch) -> None:
    """A search that takes less time, for what is said of its end."""
    monkeypatch.setattr(place_search, "ACROSS", 8)
    monkeypatch.setattr(place_judge, "JUDGED", 10)
    monkeypatch.setattr(best_place, "FINE", 1.0)


def test_no_place_is_better(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(place_judge, "JUDGED", 60)
    told = list[tuple[str, float]]()
    found = sg.place_object("barrett", BALL, posture="open", close="close", contacts=CONTACTS, task=TASK,
                            progress=lambda what, share: told.append((what, share)))  # fmt: skip
    assert found.margin == pytest.approx(margin_at(found.position), rel=1e-5)
    assert found.tried > found.touching > 100
    rng = np.random.default_rng(1)
    near = [margin_at(found.position + step) for step in rng.uniform(-0.01, 0.01, (6, 3))]
    far = [margin_at(np.array([x, y, z])) for x, y, z in rng.uniform([-0.05, -0.05, 0.1], [0.05, 0.05, 0.2], (12, 3))]
    others = np.array([*near, *far])
    assert np.isfinite(others).sum() > 5
    assert np.nanmax(others) <= 1.03 * found.margin  # of those within 2 %, the one that is held around its middle
    assert np.array_equal(np.round(found.position, 4), found.position)
    assert [what for what, share in told if share == 1] == [best_place.SEARCHING, planned_places.PLANNING]
    for what in (best_place.SEARCHING, planned_places.PLANNING):
        shares = [share for each, share in told if each == what]
        assert (shares[0], shares[-1], shares) == (0.0, 1.0, sorted(shares))
    assert found.grasp.held is not None
    assert found.grasp.held.gaps == pytest.approx([0, 0, 0], abs=1e-9)


def test_a_box_is_followed_to_its_place_however_far_it_is() -> None:
    box = sg.Object(mass=0.2, shape=sg.Box(size=(0.05, 0.06, 0.07)))
    there = replace(box, position=(-0.0001, 0.0251, 0.1483))  # found at random, 20 mm from the first good one
    grasp = sg.make_grasp("barrett", there, posture="open", close="close", contacts=CONTACTS)
    answer = plan_of_start_posture(grasp, TASK.replace(knots=1, linearise="once", goals=[sg.LargestMargin()]))
    assert isinstance(answer, sg.Plan)
    assert placed(ball=box).margin > answer.margins.min()


@pytest.mark.usefixtures("coarse")
def test_a_place_where_two_pads_meet_ends_no_search(monkeypatch: pytest.MonkeyPatch) -> None:
    soft = sg.SoftFinger(friction=0.6, spin_friction=0.005)
    tips = [sg.ContactAt(tip, soft, stiffness=8e3, spin_stiffness=0.05) for tip in ("left/tip", "right/tip")]
    ball = sg.Object(mass=0.2, shape=sg.Sphere(radius=0.02))

    def found() -> sg.PlacedObject:
        return sg.place_object("gripper", ball, posture="open", close="proximal", contacts=tips, task=TASK)

    right = found()
    assert right.margin > 0
    meet = np.array([0.00416, 0.01007, 0.09001])  # beside the tips, which close on one spot of it
    monkeypatch.setattr(best_place, "space", lambda closer: (meet[None], 0.001))
    with pytest.raises(sg.InputError, match=r"inside each other.*: 'left/tip' and 'right/tip' by 16 mm"):
        found()
    monkeypatch.setattr(best_place, "space", lambda closer: (np.vstack([meet, right.position]), 0.001))
    assert found().touching >= 1


def test_the_line_is_read_as_the_place() -> None:
    line = position_line(np.array([0.0123, -1e-12, 0.17084]))
    assert line == 'position = ["12.3 mm", "0 mm", "170.84 mm"]'
    placed = sg.load_problem("barrett-ball-hold", [f"object.{line}", "hand.posture=open", "hand.close=close"])
    assert placed.held is not None
    assert placed.held.body.position == pytest.approx([0.0123, 0.0, 0.17084], abs=1e-15)


def test_where_joints_stand_at_their_stops_is_taken_only_for_more_margin(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = asked_grasp("barrett", BALL, posture="open", close="close", contacts=CONTACTS, anywhere=True)
    assert asked.closing is not None
    ends = [joint.upper if way else 0.0 for joint, way in zip(asked.hand.joints, asked.closing, strict=True)]
    places = TouchingPlaces(np.eye(3), np.array([ends, asked.q, asked.q]), np.zeros(3, dtype=int))
    doubted = TouchingPlaces(places.positions, places.q, np.array([0, 2, 1]))
    unholdable = -np.inf
    for margins, best in (
        ([1.0, 0.96, 0.5], 1),
        ([1.0, 0.94, 0.5], 0),
        ([0.1, unholdable, unholdable], 0),
        ([unholdable, 0.1, 0.2], 2),
    ):
        monkeypatch.setattr(PlaceJudge, "margins", lambda self, among, known=margins: np.array(known))
        judge = PlaceJudge(
            asked, lambda position: NotImplemented, sg.load_problem("pinch-soft").grasp, TASK, np.zeros((1, 6)), 0.0
        )
        assert np.argmax(judge.best(places)[0].positions[0]) == best, margins
        held = [place for place in (0, 2, 1) if margins[place] > unholdable]  # with less doubt first
        assert np.argmax(judge.best(doubted)[0].positions[0]) == held[0], margins
    monkeypatch.setattr(PlaceJudge, "margins", lambda self, among: np.array([1.0, 0.96, 2.0]))
    large = TouchingPlaces(places.positions, places.q, np.array([0, 0, 1]))  # beside it no margin is nearly the largest
    assert np.argmax(judge.best(large)[0].positions[0]) == 1


@pytest.mark.usefixtures("coarse")
def test_what_cannot_be_held_is_placed_all_the_same_and_told() -> None:
    heavy = placed(TASK.replace(limits=[sg.NormalForce(upper=0.5)]))
    assert heavy.margin == -np.inf
    assert "at no place is the load held with these limits" in heavy.notes[0]
    assert "no plan holds there: infeasible, limits are too tight; no other place" in heavy.notes[1]
    assert isinstance(heavy.outcome, sg.Infeasible)


@pytest.mark.usefixtures("coarse")
def test_without_a_bound_it_is_judged_with_one_that_is_told() -> None:
    free = placed(TASK.replace(limits=[]))
    assert 0 < free.margin < 10 * 0.2 * 9.81
    assert "normal forces were held to 19.62 N" in free.notes[0]
    assert placed(TASK.replace(limits=[])).line == free.line


@pytest.mark.usefixtures("coarse")
def test_a_ball_that_no_finger_reaches_is_refused_with_the_nearest_place() -> None:
    with pytest.raises(sg.InputError, match=r"nowhere do all contacts touch.*nearest at .* mm: .* stays .* mm away"):
        placed(ball=replace(BALL, shape=sg.Sphere(radius=0.002)))
    backwards = {"spread": 0.01, "close": -1.0}  # from where the fingers are closed half
    with pytest.raises(sg.InputError, match=r"stays .* mm away \(closing takes it away from the others\)"):
        sg.place_object("barrett", BALL, posture="ball", close=backwards, contacts=CONTACTS, task=TASK,
                        synergies="close")  # fmt: skip
    with pytest.raises(sg.InputError, match=r"finger2/tip stays .* mm away \(closing does not move it\)"):
        sg.place_object("barrett", BALL, posture="open", close="finger1", contacts=CONTACTS, task=TASK)
    with pytest.raises(sg.InputError, match=r"task: expected"):
        placed(task=3)  # type: ignore[arg-type]


def test_ranges_that_are_stated_begin_at_the_posture_of_each_place() -> None:
    asked = asked_grasp("barrett", BALL, posture="open", close="close", contacts=CONTACTS, anywhere=True)
    spots = np.array([[0.0, 0.0144, 0.1708], [0.0, 0.0144, 0.165]])
    there = [grasp_of(asked.at(spot)) for spot in spots]
    q = np.array([grasp.held.q for grasp in there if grasp.held])
    places, near = TouchingPlaces(spots, q, np.zeros(2, dtype=int)), np.abs(q[1] - q[0]).max() / 2
    narrow = sg.JointRange(lower=q[0] - near, upper=q[0] + near).on(there[0])  # as a problem file makes it
    judge = PlaceJudge.of(asked, places, lambda _: (there[0], TASK.replace(limits=[*TASK.limits, narrow])))
    assert np.isfinite(judge.margins(places)).tolist() == [True, False]


def test_contacts_at_edges_are_doubtful() -> None:
    tips = [sg.ContactAt(tip, sg.HardFinger(friction=0.6), stiffness=8e3) for tip in ("left/tip", "right/tip")]
    box = sg.Object(mass=0.2, shape=sg.Box(size=(0.05, 0.05, 0.05)))
    asked = asked_grasp("gripper", box, posture="open", close="proximal", contacts=tips, anywhere=True)
    closer = Closer(asked)
    tall = closer.closed(np.array([[0.0, 0.0, 0.09]]))
    high = float(asked.hand.kinematics.at(tall.q[0], [(pad.link, pad.point) for pad in closer.pads])[0].position[2])
    at = np.array([[0.0, 0.0, high + up] for up in (0.0, 0.02, 0.0245, -0.0245)])
    found = touching_places(closer, closer.closed(at))
    assert found.doubts.tolist() == [0, 0, 1, 1]
    for sound, taken in ((3, 3), (500, 100)):
        few = place_judge._some(np.array([1] * 500 + [0] * sound))
        assert (len(few), np.count_nonzero(few >= 500)) == (place_judge.JUDGED, taken)


def test_places_deep_in_the_hand_come_after_all_others(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = asked_grasp("barrett", BALL, posture="open", close="close", contacts=CONTACTS, anywhere=True)
    closer = Closer(asked)
    found = closer.closed(np.tile([0.0, 0.0144, 0.1708], (3, 1)))
    monkeypatch.setattr(place_search, "deepest", lambda *given: np.array([-0.01, 0.002, 0.004]))
    monkeypatch.setattr(place_search, "_at_edges", lambda *given: np.array([True, True, False]))
    assert touching_places(closer, found).doubts.tolist() == [1, 2, 3]


def test_how_deep_the_hand_runs_through_the_object_is_told() -> None:
    grasp = grasp_of(asked_grasp("barrett", BALL, posture="open", close="close", contacts=CONTACTS,
                                 anywhere=True).at(np.array([0.0, 0.0144, 0.1708])))  # fmt: skip
    assert grasp.held is not None
    assert sg.PlacedObject(grasp, 1.0, 1, 1).inside == pytest.approx(0, abs=1e-4)  # its points touch
    sunk = replace(grasp, held=replace(grasp.held, body=replace(BALL, position=np.array([0.0, 0.0, 0.04]))))
    assert sg.PlacedObject(sunk, 1.0, 1, 1).inside == pytest.approx(0.05, abs=0.02)


def test_limits_that_are_refused_anywhere_are_not_tried_at_every_place() -> None:
    tried = list[float]()

    def made(position: np.ndarray) -> None:
        tried.append(position[0])
        said = f"off by {position[0]} mm" if position[0] < 3 else "this hand states no such limit"
        raise sg.InputError.at("contact[0]" if position[0] < 3 else "limits.joint_torque", said)

    with pytest.raises(sg.InputError, match="no such limit"):
        place_judge._first(np.arange(150.0).reshape(50, 3), made)  # type: ignore[arg-type]
    assert tried == [0.0, 3.0, 6.0]


def test_a_reason_is_told_in_whole_clauses() -> None:
    long = f"the hand {'very ' * 50}moves; contact 'thumb' runs over. The finger that {'so ' * 60}ends"
    assert first_clauses(long) == f"the hand {'very ' * 50}moves"
    assert first_clauses("one; two. three") == "one; two. three"


@pytest.fixture(scope="module")
def candidates() -> dict[str, Candidate]:
    """The same grasp with tasks that have a plan, that have none, and that are refused."""
    problem = sg.load_problem("pinch-soft")
    tasks = {
        "yes": problem.task,
        "no": problem.task.replace(limits=[sg.NormalForce(upper=0.01)]),
        "none": problem.task.replace(limits=[sg.JointTorque([1.0] * 77)]),
    }
    return {name: Candidate(problem.grasp, task, float(len(name))) for name, task in tasks.items()}


@pytest.mark.parametrize(
    ("asked", "verdict", "planned", "note"),
    [
        (["yes", "no"], "feasible", 1, ""),
        (["no", "yes"], "feasible", 2, "1 place was set aside that would be better by the start posture, because no "
                                       "plan holds there: infeasible, limits are too tight. At the best one: "),
        (["no", "none", "no", "yes"], "feasible", 4, "3 places were .* too tight .at 2.; the task is refused"),
        (["no", "none"], "infeasible", 2, "no plan holds at any of the 2 best .* one by the start posture"),
        (["none"], None, 1, "no plan holds there: the task is refused; no other place"),
    ],
)  # fmt: skip
def test_the_first_place_with_a_plan_is_taken(
    candidates: dict[str, Candidate], asked: list[str], verdict: str | None, planned: int, note: str
) -> None:
    told = list[float]()
    found = first_that_holds((candidates[name] for name in asked), 4, lambda what, share: told.append(share))
    assert (found.outcome.verdict if found.outcome else None, found.planned) == (verdict, planned)
    assert re.match(note, found.note) if note else not found.note
    assert found.margin == candidates[asked[planned - 1] if verdict == "feasible" else asked[0]].margin
    assert told == [*(share / 4 for share in range(planned)), 1.0]


def test_after_a_minute_no_further_place_is_planned_at(
    candidates: dict[str, Candidate], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(planned_places, "LONG", 0.0)
    found = first_that_holds([candidates["no"], candidates["yes"]], 2, lambda what, share: None)
    assert (found.planned, "after a minute" in found.note) == (1, True)


def test_places_that_are_planned_at_are_far_from_each_other() -> None:
    spots = np.array([[0.0, 0, 0], [0.001, 0, 0], [0.03, 0, 0], [0.06, 0, 0], [0.06, 0.001, 0], [0.09, 0, 0]])
    places = TouchingPlaces(spots, np.zeros((6, 1)), np.array([0, 0, 1, 0, 0, 0]))
    judged = JudgedPlaces(places, np.array([9.0, 8.0, 7.0, 2.0, 3.0, -np.inf]))
    assert judged.far_from(spots[0], 0.01, 5).positions.tolist() == [spots[4].tolist(), spots[2].tolist()]
    assert len(judged.far_from(spots[0], 0.01, 1).q) == 1
