"""A problem as far as it is known before its object is placed and its pads touch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from synergrip.documents.documents import Document
from synergrip.errors import InputError
from synergrip.grasps.asked_grasp import AskedGrasp
from synergrip.problems.file_keys import in_file
from synergrip.problems.finding import find_problem
from synergrip.problems.holding import asked_of
from synergrip.problems.problem_file import ProblemFile, read_problem_file
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class UnplacedProblem(Value):
    """Hand, object and contacts of a problem, each by itself in order."""

    file: ProblemFile
    document: Document
    asked: AskedGrasp

    def located(self, error: InputError) -> InputError:
        """Return an error of closing or placing with its place in the file."""
        return _located(self.document, error)


def unplaced_problem(name: str, overrides: Sequence[str] = ()) -> UnplacedProblem:
    """Return a problem on a hand, whether or not its contacts touch.

    Args:
        name: path of a problem file, or the name of a bundled problem.
        overrides: texts such as ``object.position="auto"``.

    Raises:
        InputError: what is wrong with hand, object or contacts, each by itself; a grasp given as matrices.
    """
    path = find_problem(name)
    file, document = read_problem_file(path, overrides)
    if file.grasp is not None:
        raise _located(document, InputError.at("grasp", "given as matrices: there is no hand to be seen"))
    try:
        return UnplacedProblem(file, document, asked_of(file, path.parent))
    except InputError as error:
        raise _located(document, error) from None


def _located(document: Document, error: InputError) -> InputError:
    return error.located(in_file).located(document.locate)
