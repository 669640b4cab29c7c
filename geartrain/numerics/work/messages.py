"""What crosses between processes: a task on its way out; on its way back, its result as JSON or what was raised.

Results are made JSON where they arise. So a result is the same whether it was worked out here, in another process, on
another machine or last week: a tuple is a list and a key is a text in all of them.
"""

from __future__ import annotations

import json
import pickle
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any
from zlib import crc32

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.decimal_text import fraction_text


@dataclass(frozen=True, slots=True)
class RemoteFailure:
    """What `work` raised, in a form that always comes through.

    A process pool takes an exception it cannot unpickle for a dead worker, and an exception whose `__init__` takes
    other arguments than its text comes back garbled.

    kind      its class, where it is a `GearTrainError`
    problems  its problems, likewise
    pickled   any other exception; empty where it cannot be pickled faithfully
    trace     the traceback there
    """

    trace: str
    kind: type[GearTrainError] | None = None
    problems: tuple[Problem, ...] = ()
    pickled: bytes = b""

    def error(self) -> Exception:
        """The exception again, with the traceback of its worker as a note."""
        error = self._again()
        error.add_note(f"raised in a worker:\n{self.trace}")
        return error

    def _again(self) -> Exception:
        if self.kind is not None:
            error = self.kind.__new__(self.kind)
            GearTrainError.__init__(error, self.problems)
            return error
        if self.pickled:
            back = pickle.loads(self.pickled)
            assert isinstance(back, Exception)
            return back
        return RuntimeError(self.trace.rstrip().rpartition("\n")[2])


def as_text(result: Any) -> str:
    """A result as one line of JSON. Raises `TypeError` where it is no plain data."""
    return json.dumps(result, separators=(",", ":"))


def carry(work: Callable[[Any], Any], task: Any) -> str | RemoteFailure:
    """Do one task in a worker: its result as JSON, or what it raised."""
    try:
        return as_text(work(task))
    except Exception as error:
        return raised(error)


def raised(error: Exception) -> RemoteFailure:
    """Pack an exception."""
    trace = "".join(traceback.format_exception(error))
    if isinstance(error, GearTrainError):
        return RemoteFailure(trace, type(error), error.problems)
    try:
        pickled = pickle.dumps(error)
        back = pickle.loads(pickled)
    except Exception:  # pickling calls code of the exception's own
        return RemoteFailure(trace)
    # an exception whose __init__ takes other arguments may come back as another text, or not as itself
    faithful = type(back) is type(error) and str(back) == str(error)
    return RemoteFailure(trace, pickled=pickled if faithful else b"")


def mark_of(task: Any) -> str:
    """A short mark by which a journal knows a task again; empty for a task that is no plain data (nor a Fraction)."""
    try:
        text = json.dumps(task, separators=(",", ":"), default=_fraction)
    except (TypeError, ValueError):
        return ""
    return f"{crc32(text.encode()):08x}"


def _fraction(value: Any) -> str:
    if isinstance(value, Fraction):
        return fraction_text(value)
    raise TypeError
