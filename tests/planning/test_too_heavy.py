"""What is too much for a hand that squeezes well is no matter of its normals, unless some point the wrong way."""

from __future__ import annotations

import numpy as np
import pytest

import synergrip as sg
from synergrip.planning import reversed_normals

LIMITS = [sg.SlipMargin(0.3), sg.NormalForce(upper=15.0), sg.JointTorque(0.8)]


def four_fingers(*turned: int) -> sg.Grasp:
    """A thumb against three fingers around a bar, as matrices; all normals point into it but for some turned round."""
    G, J, S = np.zeros((6, 12)), np.zeros((12, 12)), np.zeros((12, 5))
    for i, (degrees, height) in enumerate([(180, 0.0), (40, 0.02), (0, 0.0), (-40, -0.015)]):
        angle, rows = np.radians(degrees), slice(3 * i, 3 * i + 3)
        n = -np.array([np.cos(angle), np.sin(angle), 0.0])
        t = np.cross([0.0, 0.0, 1.0], n)
        frame, point = np.column_stack([n, t, np.cross(n, t)]), -0.035 * n + [0.0, 0.0, height]
        base = point - 0.03 * n - [0.0, 0.0, 0.07]
        middle = point - 0.02 * n - [0.0, 0.0, 0.03]
        hinges = [(frame[:, 2], base), (t, base), (t, middle)]
        G[:, rows] = np.vstack([frame, np.cross(point, frame.T).T])
        J[rows, rows] = frame.T @ np.column_stack([np.cross(axis, point - at) for axis, at in hinges])
        S[3 * i + 1, i] = 1.0
        S[3 * i + 2, i] = 0.6 if i == 0 else 0.5
    S[3, 4], S[9, 4] = 1.0, -1.0
    for i in turned:
        G[:, 3 * i], J[3 * i] = -G[:, 3 * i], -J[3 * i]
    contacts = [(f"f{i}", sg.HardFinger(friction=0.5)) for i in range(4)]
    return sg.grasp_from_matrices(G=G, J=J, S=S, contacts=contacts, C_s=2e-4, C_q=0.02)


@pytest.mark.parametrize("seed", range(12))
def test_a_load_that_is_too_heavy_brings_no_word_of_normals(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(seed)
    push = rng.normal(size=3)
    load = sg.Wrench((*(20 * push / np.linalg.norm(push)), 0.0, 0.0, 0.0))
    tried = list[object]()
    holds = reversed_normals._holds
    monkeypatch.setattr(reversed_normals, "_holds", lambda *given: tried.append(given) or holds(*given))
    answer = sg.plan(four_fingers(), sg.Task(knots=1, loads=[load], limits=LIMITS))
    assert isinstance(answer, sg.Infeasible)
    assert answer.hints == ()
    assert len(tried) == 1


@pytest.mark.parametrize("turned", [(2,), (3,), (0, 1, 2), (0, 1, 3), (0, 1, 2, 3)], ids=str)
def test_normals_that_are_turned_round_are_found_though_the_hand_can_squeeze(turned: tuple[int, ...]) -> None:
    rng = np.random.default_rng(3 if turned != (0, 1, 2) else 6)
    push = rng.normal(size=3)
    push *= rng.uniform(1, 5) / np.linalg.norm(push)
    task = sg.Task(knots=1, loads=[sg.Wrench((*push, 0.0, 0.0, 0.0))], limits=LIMITS)
    assert isinstance(sg.plan(four_fingers(), task), sg.Plan)
    wrong = sg.plan(four_fingers(*turned), task)
    assert isinstance(wrong, sg.Infeasible)
    (hint,) = wrong.hints
    assert "reversed the task can be done" in hint
    assert [name for name in ("f0", "f1", "f2", "f3") if f"'{name}'" in hint] == [f"f{i}" for i in turned]
