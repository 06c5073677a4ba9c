"""What the examples in docstrings take as given: the public names, and a grasp with what follows from it."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
from held_ball import at, ball, grasp, hand, hard, task

import synergrip as sg


@cache
def around() -> dict[str, Any]:
    """Return all of it by name."""
    answer = sg.plan(grasp, task)
    assert isinstance(answer, sg.Plan)
    pinch = sg.grasp_from_matrices(
        G=np.hstack([np.eye(6)[:, :3]] * 2),
        J=np.eye(6),
        S=np.ones((6, 1)),
        contacts=[("a", hard), ("b", hard)],
        C_s=1e-4,
    )
    weak = task.replace(loads=[sg.Gravity((0, 0, -9.81))], limits=[sg.NormalForce(upper=0.1)])
    softer = grasp.replace(C_s=2 * grasp.C_s)
    responses = sg.respond_many([grasp, softer])
    given = {
        "np": np, "math": math, "hand": hand, "object": ball, "contacts": at, "grasp": grasp, "softer": softer,
        "grasps": [grasp, softer], "responses": responses, "group": sg.subspaces_many(responses)[0],
        "dz_r": np.zeros((2, 3, 4)), "task": task, "answer": answer, "slipping": pinch, "refused": sg.plan(grasp, weak),
        "formulation": answer.formulation,
    }  # fmt: skip
    return {name: getattr(sg, name) for name in sg.__all__} | given
