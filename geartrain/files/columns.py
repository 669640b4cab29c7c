"""Columns to disk as Parquet, row group by row group: under a name that says partial until they are whole."""

from __future__ import annotations

import os
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from types import TracebackType
from typing import Any

from geartrain.errors import GearTrainError, MissingExtraError, Problem
from geartrain.files.long import partial_name


class ColumnTable:
    """A Parquet file that grows by row groups as `name.partial.parquet`, and becomes `name.parquet` when it is whole.

    about   texts kept beside the columns; readers of Parquet show them as metadata

    Interrupted, the partial file is closed and can be read as far as it goes. Raises `MissingExtraError` without
    pyarrow, `GearTrainError` where nothing can be written.
    """

    def __init__(self, path: Path, about: Mapping[str, str]) -> None:
        try:
            self._arrow: Any = import_module("pyarrow")  # it carries no types
            import_module("pyarrow.parquet")
        except ImportError:
            raise MissingExtraError("pyarrow", "errors", "Parquet") from None
        self._writer: Any = None
        self.path, self.partial, self.about, self.rows = path, partial_name(path), dict(about), 0

    def write(self, columns: Mapping[str, Any]) -> None:
        """Append arrays of one length as one row group. Raises `GearTrainError`."""
        table = self._arrow.table(dict(columns))
        try:
            if self._writer is None:
                schema = table.schema.with_metadata(self.about)
                self._writer = self._arrow.parquet.ParquetWriter(self.partial, schema)
            self._writer.write_table(table.cast(self._writer.schema), row_group_size=max(1, table.num_rows))
        except (OSError, self._arrow.ArrowException) as error:
            raise self._trouble(error) from None
        self.rows += table.num_rows

    def __enter__(self) -> ColumnTable:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        """Whole: take the name asked for. Interrupted: stay partial."""
        if self._writer is None:
            return
        try:
            self._writer.close()
            if kind is None:
                os.replace(self.partial, self.path)
        except OSError as trouble:
            if kind is None:  # else what ended the run is said, not this
                raise self._trouble(trouble) from None

    def _trouble(self, error: Exception) -> GearTrainError:
        why = getattr(error, "strerror", None) or str(error)
        fix = "make room, or check the folder and its permissions"
        return GearTrainError(Problem("the file cannot be written", why, fix, str(self.partial)))
