"""What commands that may run for long share: an executor, a journal of what is done, a progress bar, how they end."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from geartrain.cli.common import tell

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from geartrain.numerics.work import Journal

    RunExecution = tuple[Executor | None, Journal | None, Callable[[int, int], None]]


@contextmanager
def means(
    what: str, path: Path, question: Mapping[str, Any], workers: int | None, scheduler: str | None, resume: bool
) -> Iterator[RunExecution]:
    """An executor, a journal at `path` and a progress bar; where no file can be made, there is no journal."""
    from rich.console import Console
    from rich.progress import Progress, TimeElapsedColumn

    from geartrain.numerics.work import open_executor

    columns = (*Progress.get_default_columns(), TimeElapsedColumn())
    with (
        open_executor(workers, scheduler) as executor,
        _journal(path, json.loads(json.dumps(question, default=str)), resume) as journal,
        Progress(*columns, console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty()) as progress,
    ):
        task = progress.add_task(what, total=None, visible=False)
        yield (
            executor,
            journal,
            lambda done, total: progress.update(task, completed=done, total=total or None, visible=total > 1),
        )


@contextmanager
def _journal(path: Path, question: Mapping[str, Any], resume: bool) -> Iterator[Journal | None]:
    import os

    from geartrain.numerics.work import Journal

    if not resume and not os.access(path.parent, os.W_OK):
        yield None
        return
    if resume and not path.exists():
        _check_others(path, question)
        tell(f"nothing to resume: there is no {path}; the run begins anew")
    with Journal(path, question, resume=resume) as journal:
        try:
            yield journal
        finally:
            if not journal.closed and not len(journal):  # nothing worth keeping
                journal.finish()


def _check_others(path: Path, question: Mapping[str, Any]) -> None:
    """Refuse to resume where the folder holds journals of the same command, all of other questions."""
    from geartrain.errors import QuestionError
    from geartrain.numerics.work import another_question

    others = sorted(path.parent.glob(f"{path.name.partition('-')[0]}-*.partial.jsonl"))
    if problems := [another_question(other, question) for other in others]:
        raise QuestionError(problems)


def close_journal(journal: Journal | None, cut: bool) -> None:
    """A run that is whole needs no journal; for one that was cut, say where it can be taken up."""
    if not cut:
        if journal is not None:
            journal.finish()
    elif journal is not None and len(journal):
        tell(f"stopped; what is done is in {journal.path}: give the same command with --resume")
    else:
        tell("stopped before anything was done that could be kept")


def table_text(rows: Sequence[Mapping[str, Any]]) -> str:
    """Rows with the same keys as CSV with a header; empty without rows."""
    from geartrain.numerics.files import csv_text

    return csv_text(list(rows[0]), [list(row.values()) for row in rows]).rstrip("\n") if rows else ""
