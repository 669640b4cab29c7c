"""What every search for tooth numbers is asked with: bounds, tolerance, order, who works, and where results go."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from geartrain.cli.common import GOOD, INTERRUPTED, STANDARD, VERDICT, Sink, as_json, emit, share, show
from geartrain.cli.long_runs import means, table_text

if TYPE_CHECKING:
    from geartrain.cli.long_runs import Means as Work
    from geartrain.report import Document
    from geartrain.synthesis.counts import Runs

YAML = (".yaml", ".yml")
_WIDEST = 10**12
FORMS = (".md", ".html", ".json", ".csv", *YAML)


@dataclass(frozen=True)
class Asked:
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
        found = share(self.tolerance_text, "--tolerance")
        if not 0 <= found <= _WIDEST:
            raise typer.BadParameter(f"a relative error is from 0 to {_WIDEST:.0e}", param_hint="--tolerance")
        return found

    @property
    def counts(self) -> Runs:
        """Counts of any wheel."""
        from geartrain.synthesis.counts import read_counts

        return read_counts(self.range)

    @property
    def wheels(self) -> Runs:
        """Counts of the larger wheels."""
        from geartrain.synthesis.counts import read_counts

        return read_counts(self.wheels_text or self.range)

    @property
    def pinions(self) -> Runs:
        """Counts of the smaller wheels."""
        from geartrain.synthesis.counts import read_counts

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
        from geartrain.files import as_yaml

        if declared is None:
            raise typer.BadParameter("a ratio alone is no train to be written", param_hint="-o")
        if self.pick <= found:
            emit(as_yaml(declared(self.pick - 1)), self.out)
        elif found:
            raise typer.BadParameter(f"there are {found} solutions in the list", param_hint="--pick")


@dataclass(frozen=True)
class Means:
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
    from geartrain.files import shipped

    return text.endswith(YAML) or text in shipped()
