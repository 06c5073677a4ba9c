"""A problem whose object is still to be placed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from synergrip.errors import InputError
from synergrip.grasps.asked_grasp import AskedGrasp
from synergrip.problems.holding import asked_of, in_file
from synergrip.problems.problem import find_problem
from synergrip.problems.problem_file import read_problem_file


@contextmanager
def unplaced(name: str, overrides: Sequence[str] = ()) -> Iterator[AskedGrasp]:
    """Give what is to become the grasp of a problem; errors inside the block get their place in its file.

    Args:
        name: path of a problem file, or the name of a bundled problem.
        overrides: texts such as ``object.position="auto"``.

    Raises:
        InputError: what is wrong with hand, object or contacts, each by itself.
    """
    path = find_problem(name)
    file, document = read_problem_file(path, overrides)
    try:
        yield asked_of(file, path.parent)
    except InputError as error:
        raise error.located(in_file).located(lambda issue: issue if issue.file else document.locate(issue)) from None
