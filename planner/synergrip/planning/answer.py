"""What every answer does: it says which attributes are another verdict's, and hands itself out as files and tables.

This is the one file of its room that looks to its right, and only inside these methods: how an answer is written and
drawn is the business of reports, and whoever holds an answer should not have to know that.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, cast

from synergrip.documents.naming import naming_arguments
from synergrip.errors import Issue, VerdictError, shortened, suggest
from synergrip.values import Value

if TYPE_CHECKING:
    from synergrip.explain.explanation import Explanation
    from synergrip.explain.repairs import Repair
    from synergrip.explain.synergies.missing_synergies import MissingSynergies
    from synergrip.explain.when import When
    from synergrip.margin.found import Margins
    from synergrip.planning.outcome import Infeasible, Outcome, Plan, Unknown
    from synergrip.planning.provenance import Asked
    from synergrip.reports.data.viewer import Viewer

FORMATS = ("json", "npz", "csv")
"""How an answer is written when nothing else is said; of an answer without a plan there is only the first."""
LONG = 200
"""Characters of a reason that are shown."""


class Answer(Value):
    """The base of the three answers: `Plan`, `Infeasible` and `Unknown`."""

    verdict: ClassVar[str]
    holds: ClassVar[tuple[str, ...]]
    """What is to be looked at in an answer of this kind."""

    @naming_arguments
    def save(
        self, folder: str | Path, *, formats: Sequence[str] = FORMATS, problem: Asked | None = None
    ) -> tuple[Path, ...]:
        """Write the files that the command line writes, all or none: plan.json, and of a plan plan.npz and plan.csv.

        Args:
            folder: made when it is not there. An earlier answer in it is replaced, other files stay.
            formats: some of "json", "npz" and "csv"; a single text is one of them.
            problem: what was asked, as `load_problem` returns it, for title, notes and provenance.

        Returns:
            The files written.

        Raises:
            InputError: a format that is none of these, or a path that can be no folder's.
            OutputError: it cannot be written; the folder is as it was.

        Example:
            >>> answer.save("out/ball")  # doctest: +SKIP
            (PosixPath('out/ball/plan.json'), PosixPath('out/ball/plan.npz'), PosixPath('out/ball/plan.csv'))
        """
        from synergrip.reports.data.saving import save

        return save(cast("Outcome", self), folder, formats, problem)

    @naming_arguments
    def report(self, path: str | Path, *, problem: Asked | None = None, margins: Margins | None = None) -> Path:
        """Write the report, the page of ``synergrip plan --report``, and return the file: it opens offline.

        A simulation and margins of this very answer in the folder of the file (``synergrip simulate FOLDER -o FOLDER``,
        ``synergrip margins FOLDER -o FOLDER``) are a part of it.

        Args:
            path: the file, replaced whole or not at all.
            problem: what was asked, as `load_problem` returns it, for title, notes and inputs.
            margins: of this plan, what `margins` returns for its grasp and task, in place of those in the folder.

        Raises:
            InputError: viser or Jinja is not installed, a path that can be no file's, or margins of another plan.
            OutputError: it cannot be written.

        Example:
            >>> answer.report("ball.html")  # doctest: +SKIP
            PosixPath('ball.html')
        """
        from synergrip.reports.data.saving import report

        return report(cast("Outcome", self), path, problem, margins)

    @naming_arguments
    def viewer(self, *, height: int = 480) -> Viewer:
        """Return the 3-D view for a notebook: hand, object, cones and forces, played in place and without a network.

        Args:
            height: of the view [pixels].

        Raises:
            InputError: viser is not installed, a grasp given as matrices, which has no hand to be seen, or a height
                that is none.

        Example:
            >>> answer.viewer(height=600)  # doctest: +SKIP
            <Viewer: 41 frames of a hand with 3 contacts; a notebook shows it, .save("view.html") writes it>
        """
        from synergrip.reports.data.saving import viewer

        return viewer(cast("Outcome", self), height)

    if not TYPE_CHECKING:  # or every misspelt attribute would pass

        def __getattr__(self, name: str) -> Any:
            """Say of which verdict an attribute is that this answer does not have."""
            owners = () if name.startswith("_") else tuple(_owners(name))
            if owners:
                raise VerdictError([Issue(_elsewhere(self, name, owners), key=f"{type(self).__name__}.{name}")])
            names = {*dir(type(self)), *type(self).__dataclass_fields__}
            near = suggest(name, sorted(each for each in names if not each.startswith("_")))
            message = f"'{type(self).__name__}' object has no attribute '{name}'{near}"
            raise AttributeError(message, name=name, obj=self)


class Tabled(Answer):
    """An answer with arrays: a table of them, and a picture."""

    @naming_arguments
    def frame(self) -> Any:
        """Return the columns of plan.csv as a pandas `DataFrame`, one row for each knot.

        Raises:
            InputError: pandas is not installed; synergrip itself does not need it.

        Example:
            >>> answer.frame().plot("t_s", "margin_C1_N")  # doctest: +SKIP
        """
        from synergrip.reports.data.frames import frame

        return frame(cast("Plan", self))

    @naming_arguments
    def draw(self, path: str | Path, *, title: str = "") -> Path:
        """Draw the plan over time, the picture of ``synergrip plan --picture``, and return the file.

        Args:
            path: the file, replaced whole or not at all: .svg, .png or .pdf.
            title: above the picture; that of the grasp when empty.

        Raises:
            InputError: a suffix that says no format, or a path that can be no file's.
            OutputError: it cannot be written.

        Example:
            >>> answer.draw("ball.svg")  # doctest: +SKIP
            PosixPath('ball.svg')
        """
        from synergrip.reports.data.saving import draw

        return draw(cast("Plan", self), path, title)

    @naming_arguments
    def export(self, folder: str | Path, *, to: str | Sequence[str]) -> tuple[Path, ...]:
        """Write the plan in formats of other programs, all or none; see `synergrip.export`.

        Args:
            folder: made when it is not there.
            to: some of "csv", "npz", "parquet", "ros2-yaml", "mcap", "isaac_grasp", "moveit_grasp" and "mjcf"; a
                single text is one of them.

        Returns:
            The files written.

        Raises:
            InputError: a format that this plan does not have, or a path that can be no folder's.
            OutputError: it cannot be written; the folder is as it was.

        Example:
            >>> answer.export("out/ball/export", to="csv")  # doctest: +SKIP
            (PosixPath('out/ball/export/trajectory.csv'),)
        """
        from synergrip.reports.data.exports.exporting import export

        return export(cast("Plan", self), folder, to=to)

    def _repr_html_(self) -> str:
        """Return verdict, the worst value of every limit, and the slip margins over time, for notebooks."""
        from synergrip.reports.data.saving import notebook

        return notebook(cast("Plan", self))


class Reasoned(Answer):
    """An answer that gives a reason instead of a plan."""

    why: str

    @cached_property
    def explanation(self) -> Explanation:
        """What is to blame, what clashes, when, and the three smallest changes that help, each planned again."""
        return self._explained(short=True, heard=None)

    @property
    def repairs(self) -> tuple[Repair, ...]:
        """The smallest changes of single numbers that help, the smallest first, each planned again."""
        return self.explanation.repairs

    @property
    def when(self) -> When:
        """Which instants have no plan."""
        return self.explanation.when

    @property
    def missing_synergies(self) -> MissingSynergies | None:
        """The fewest columns beside S that the wanted motion takes, and who has them; None where none are missing."""
        return self.explanation.missing_synergies

    @naming_arguments
    def explain(self, *, heard: Callable[[Repair], None] | None = None) -> Explanation:
        """Return all that is known of the no: every change that helps, and proofs that less does not.

        Args:
            heard: is told of each repair as it is found.

        Example:
            >>> answer.explain().repairs[0].set  # doctest: +SKIP
            'limits.normal_force="26.04 N"'
        """
        return self._explained(short=False, heard=heard)

    def _explained(self, *, short: bool, heard: Callable[[Repair], None] | None) -> Explanation:
        from synergrip.explain.explained import explained

        no = cast("Infeasible | Unknown", self)
        return explained(no, short=short) if heard is None else explained(no, short=short, heard=heard)

    def _repr_html_(self) -> str:
        """Return the verdict and the reason for notebooks."""
        return f"<p><b>{escape(self.verdict)}</b>: {escape(shortened(self.why, 2 * LONG))}</p>"


def _owners(name: str) -> Iterator[str]:
    """Yield the answers that have an attribute, as a field or as a property."""
    for kind in _kinds(Answer):
        if hasattr(kind, name) or name in getattr(kind, "__dataclass_fields__", ()):
            yield kind.__name__


def _kinds(kind: type[Answer]) -> Iterator[type[Answer]]:
    """Yield the answers below a base, or itself when there are none."""
    below = kind.__subclasses__()
    for each in below:
        yield from _kinds(each)
    if not below:
        yield kind


def _elsewhere(answer: Answer, name: str, owners: Sequence[str]) -> str:
    """Return which answers have an attribute, and what this one has instead."""
    instead = ", ".join(f".{each}" for each in answer.holds)
    return f"the verdict is '{answer.verdict}', and only {' or '.join(owners)} has .{name}; this answer has {instead}"
