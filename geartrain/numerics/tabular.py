"""Results that are tables: columns by name, as a pandas DataFrame, a numpy record array, or a table of HTML."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from html import escape
from itertools import islice
from typing import Any

from geartrain.errors import MissingExtraError

_SHOWN = 20


class Tabular:
    """What has rows of one kind.

    Notebooks show its first rows.
    """

    __slots__ = ()

    @property
    @abstractmethod
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of one length by name: numbers as floats, exact ones as text beside them, None where nothing is."""

    def to_frame(self) -> Any:
        """The table as a pandas DataFrame.

        Raises
        ------
        MissingExtraError
            Without pandas, which the extra `tables` brings.
        """
        try:
            import pandas
        except ImportError:
            raise MissingExtraError("pandas", "tables", "a table of its kind") from None
        return pandas.DataFrame(dict(self.columns))

    def to_records(self) -> Any:
        """The table as a numpy record array, `records["link"]` a column; numbers that are not there are NaN."""
        import numpy as np

        columns = {name: np.array(_without_gaps(values)) for name, values in self.columns.items()}
        kinds = [(name, column.dtype) for name, column in columns.items()]
        return np.rec.fromarrays(list(columns.values()), dtype=kinds)

    def _repr_html_(self) -> str:
        columns = self.columns
        head = "".join(f"<th>{escape(name)}</th>" for name in columns)
        rows = ("".join(f"<td>{_cell(value)}</td>" for value in row) for row in zip(*columns.values(), strict=True))
        body = "".join(f"<tr>{row}</tr>" for row in islice(rows, _SHOWN))
        more = len(next(iter(columns.values()), ())) - _SHOWN
        return f"<table><tr>{head}</tr>{body}</table>" + (f"<p>{more:,} more</p>" if more > 0 else "")


def _without_gaps(values: Sequence[Any]) -> Sequence[Any]:
    """NaN for None among numbers, nothing for None among texts."""
    if not any(value is None for value in values):
        return values
    texts = any(isinstance(value, str) for value in values)
    return [("" if texts else float("nan")) if value is None else value for value in values]


def _cell(value: object) -> str:
    if value is None:
        return ""
    return escape(value) if isinstance(value, str) else f"{value:.10g}" if isinstance(value, float) else str(value)
