"""Which options belong to which search: one that would be passed over in silence is refused.

What every search for tooth numbers is asked with: bounds, tolerance, order, who works, and where results go.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import typer

from geartrain.cli.common import GOOD, INTERRUPTED, STANDARD, VERDICT, Sink, as_json, emit, read_share, show
from geartrain.cli.long_runs import means, table_text

if TYPE_CHECKING:
    from geartrain.cli.long_runs import RunExecution as Work
    from geartrain.report.document import Document
    from geartrain.synthesis.tooth_count_ranges import CountRuns


SearchSubject = Literal["a ratio", "the fractions on the way", "a train", "an epicyclic set", "an orrery"]

_FORM = {"wanted", "kind", "csv", "json", "out", "force", "workers"}
_LIST = {"tolerance", "best", "by", "pick"}
_RULES = {
    *("planets", "clearance", "undercut", "interference", "largest_radius", "addendum", "ring_addendum", "least"),
    *("most_teeth", "shift", "coaxial", "hunting", "different", "closure"),
}
_RATIO = {"counts", "wheels", "pinions", "per"}
_PAIRING = {"stages", "internal", "hunting", "reverted", "different", "most_total"}
_LONG = {"scheduler", "resume"}
_KNOWN: dict[SearchSubject, set[str]] = {
    "a ratio": _FORM | _LIST | _RATIO | _PAIRING | _LONG,
    "the fractions on the way": _FORM | _RATIO | {"approximants"},
    "a train": _FORM | _LIST | _RULES | _LONG | {"free", "state", "where"},
    "an epicyclic set": _FORM | _LIST | {"counts", "mode", "ratio_is", "planets", "clearance", "per", "shift"},
    "an orrery": _FORM | {"counts", "tolerance", "effort", "walk"},
}
_SPELLED = {"counts": "--range", "coaxial": "--coaxial/--no-coaxial"}


def check(context: typer.Context, subject: SearchSubject) -> None:
    """`BadParameter` for options that were given and that the search for this subject does not know."""
    foreign = [
        _SPELLED.get(name, f"--{name.replace('_', '-')}")
        for name in context.params
        if name not in _KNOWN[subject] and _given(context, name)
    ]
    if foreign:
        raise typer.BadParameter(f"this is not asked of {subject}; leave it out", param_hint=", ".join(foreign))


def check_texts(context: typer.Context, texts: list[str]) -> None:
    """Negative ratios pass as arguments; anything else with a dash in front is an option that there is not."""
    for text in texts:
        if text.startswith("-") and not text[1:2].isdigit() and text[1:2] != ".":
            raise typer.BadParameter(f"there is no option '{text}'; {context.command_path} -h lists them")


def _given(context: typer.Context, name: str) -> bool:
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


YAML = (".yaml", ".yml")
_WIDEST = 10**12
FORMS = (".md", ".html", ".json", ".csv", *YAML)


@dataclass(frozen=True)
class SearchOptions:
    """Options that all searches share."""

    tolerance_text: str | None
    best: int
    by: str
    range: str
    wheels_text: str | None
    pinions_text: str | None
    csv: bool
    json: bool
    out: Sink
    pick: int

    @property
    def tolerance(self) -> Fraction | None:
        """The greatest relative error."""
        if self.tolerance_text is None:
            return None
        found = read_share(self.tolerance_text, "--tolerance")
        if not 0 <= found <= _WIDEST:
            raise typer.BadParameter(f"a relative error is from 0 to {_WIDEST:.0e}", param_hint="--tolerance")
        return found

    @property
    def counts(self) -> CountRuns:
        """Counts of any wheel."""
        from geartrain.synthesis.tooth_count_ranges import read_counts

        return read_counts(self.range)

    @property
    def wheels(self) -> CountRuns:
        """Counts of the larger wheels."""
        from geartrain.synthesis.tooth_count_ranges import read_counts

        return read_counts(self.wheels_text or self.range)

    @property
    def pinions(self) -> CountRuns:
        """Counts of the smaller wheels."""
        from geartrain.synthesis.tooth_count_ranges import read_counts

        return read_counts(self.pinions_text or self.range)

    def answer(
        self,
        data: Mapping[str, Any],
        rows: Sequence[Mapping[str, Any]],
        document: Callable[[], Document],
        declared: Callable[[int], Mapping[str, Any]] | None = None,
    ) -> None:
        """Print or write an answer in the form asked for; exit 0 if something was found, 1 if not, 130 if cut.

        rows       the solutions as a flat table
        declared   number of a solution, from 0 -> its declaration
        """
        suffix = self.out.suffix
        if suffix in YAML:
            self._declare(declared, len(rows))
        form = suffix or (".json" if self.json else ".csv" if self.csv else ".md")
        asked = {form} if self.out != STANDARD and form not in YAML else set[str]()
        asked |= {".json"} if self.json else {".csv"} if self.csv else set()
        for each in sorted(asked or {""}):
            out = self.out if each == form else STANDARD
            if each == ".json":
                emit(as_json(data), out)
            elif each == ".csv":
                emit(table_text(rows), out)
            else:
                show([document()], out, each)
        if "interrupted" in str(data.get("ended", "")):
            raise typer.Exit(INTERRUPTED)
        raise typer.Exit(GOOD if rows else VERDICT)

    def _declare(self, declared: Callable[[int], Mapping[str, Any]] | None, found: int) -> None:
        from geartrain.train.yaml_nodes import as_yaml

        if declared is None:
            raise typer.BadParameter("a ratio alone is no train to be written", param_hint="-o")
        if self.pick <= found:
            emit(as_yaml(declared(self.pick - 1)), self.out)
        elif found:
            raise typer.BadParameter(f"there are {found} solutions in the list", param_hint="--pick")


@dataclass(frozen=True)
class SearchExecution:
    """Who does the work, and where what is done is kept."""

    workers: int | None
    scheduler: str | None
    resume: bool
    out: Path | None

    @contextmanager
    def work(self, question: Mapping[str, Any]) -> Iterator[Work]:
        """An executor, a journal and a progress bar for one search. Where no file can be made, there is no journal."""
        plain = json.loads(json.dumps(question, default=str))
        mark = hashlib.sha256(json.dumps(plain, sort_keys=True).encode()).hexdigest()[:8]
        path = (self.out.parent if self.out else Path()) / f"teeth-{mark}.partial.jsonl"
        with means("teeth", path, plain, self.workers, self.scheduler, self.resume) as found:
            yield found


def is_train(text: str) -> bool:
    """True if a text names a file or a shipped train rather than a ratio."""
    from geartrain.train.declaration_files import shipped

    return text.endswith(YAML) or text in shipped()
