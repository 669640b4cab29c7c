"""How a row gets its value: a command of geartrain, run in this process, or an expression of Python."""

from __future__ import annotations

import json
from abc import ABC, abstractmethod
from collections.abc import Mapping
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from functools import lru_cache
from io import StringIO
from typing import Any

from geartrain.cli import app


class Way(ABC):
    """What a reader types, and what it gives."""

    @property
    @abstractmethod
    def text(self) -> str:
        """For the page."""

    @abstractmethod
    def value(self) -> Any:
        """What it gives."""


@dataclass(frozen=True)
class Command(Way):
    """A value of a command's JSON: `words` as on a terminal, without geartrain and --json; `path` such as a.0.b."""

    words: str
    path: str

    @property
    def text(self) -> str:
        """The command and where in its answer the value stands."""
        return f"`geartrain {self.words} --json`: `{self.path}`"

    def value(self) -> Any:
        """The value at the path."""
        found = answer(self.words)
        for key in self.path.split("."):
            found = found[int(key)] if isinstance(found, list) else found[key]
        return found


@lru_cache(maxsize=64)
def answer(words: str) -> Any:
    """What a command prints as JSON. A verdict of a train is an answer, too: only its exit code says so."""
    printed = StringIO()
    with redirect_stdout(printed):
        app([*words.split(), "--json"], standalone_mode=False)
    return json.loads(printed.getvalue())


@dataclass(frozen=True)
class Call(Way):
    """An expression of Python, worked out as it stands on the page, with the names of its module."""

    expression: str
    names: Mapping[str, Any] = field(compare=False, repr=False)

    @property
    def text(self) -> str:
        """The expression."""
        return f"`{self.expression}`"

    def value(self) -> Any:
        """Its value."""
        return eval(self.expression, dict(self.names))
