"""Plans on grasps whose stiffnesses differ by 1e9, their forces and margins worked out in decimal arithmetic."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from decimal_response import decimal_maps
from elastic_grasp import slip_margins
from named_goals import goals
from random_trajectories import random_trajectory

from synergrip.errors import RigidContactError
from synergrip.linalg import frozen
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan


def test_forces_and_margins_of_a_plan_are_what_its_references_cause() -> None:
    plans = 0
    for seed in range(24):
        grasp, task = random_trajectory(seed, 4)
        stiff = np.diag(10.0 ** np.random.default_rng(seed).uniform(-9, 0, grasp.n_l))
        grasp = replace(grasp, C_s=frozen(stiff), lambda_0=None, w_0=frozen(np.zeros(6)))
        task = replace(task, margin=0.0, limits=(), goals=goals("effort"), between="report", tolerance=1.0)
        outcome = plan(grasp, task)
        if not isinstance(outcome, Plan):
            assert isinstance(outcome, Infeasible), seed
            continue
        plans += 1
        maps = decimal_maps(grasp)
        forces = outcome.motion.dz_r @ maps["dlambda_dzr"].T + outcome.motion.wrench @ maps["dlambda_dw"].T
        terms = np.abs(outcome.motion.dz_r) @ np.abs(maps["dlambda_dzr"]).T  # rounding is theirs
        size = max(float(np.abs(forces).max()), float(terms.max()))
        assert np.abs(outcome.motion.forces - forces).max() <= 1e-12 * size, seed
        assert np.allclose(outcome.margins, slip_margins(grasp, forces), rtol=0, atol=2e-12 * size), seed
    assert plans >= 8


@pytest.mark.parametrize("compliance", [1e-3, 1e-9, 1e-12, 1e-15, 1e-18, 0.0])
def test_ever_stiffer_contacts_end_in_an_answer_or_a_refusal(compliance: float) -> None:
    for seed in range(4):
        grasp, task = random_trajectory(seed, 3)
        for joints in (0.02, 0.0):
            eyes = np.eye(grasp.n_l), np.eye(grasp.n_q)
            stiff = replace(grasp, C_s=frozen(compliance * eyes[0]), C_q=frozen(joints * eyes[1]))
            if compliance == 0.0:
                with pytest.raises(RigidContactError):
                    plan(stiff, task)
            else:
                outcome = plan(stiff, task)  # no SelfCheckError
                assert outcome.verdict != "unknown" or outcome.why.startswith("sensitive: ")
