"""Columns to disk as Parquet, row group by row group: under a name that says partial until they are whole."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from types import TracebackType
from typing import Any

from geartrain.errors import MissingExtraError
from geartrain.files.long import partial_file
from geartrain.files.writing import place, unwritten


class ColumnTable:
    """A Parquet file that grows by row groups as `name.partial.parquet`, and becomes `name.parquet` when it is whole.

    about   texts kept beside the columns; readers of Parquet show them as metadata
    force   write over a table that is there
    replay  begin the partial file of an interrupted run again

    Interrupted, the partial file is closed and can be read as far as it goes. Raises `MissingExtraError` without
    pyarrow, `GearTrainError` where nothing can be written.
    """

    def __init__(self, path: Path, about: Mapping[str, str], force: bool = False, replay: bool = False) -> None:
        try:
            self._arrow: Any = import_module("pyarrow")  # it carries no types
            import_module("pyarrow.parquet")
        except ImportError:
            raise MissingExtraError("pyarrow", "errors", "Parquet") from None
        self._writer: Any = None
        self.path, self.partial, self.force = path, partial_file(path, force, replay), force
        self.about, self.rows = dict(about), 0

    def write(self, columns: Mapping[str, Any]) -> None:
        """Append arrays of one length as one row group. Raises `GearTrainError`."""
        table = self._arrow.table(dict(columns))
        try:
            if self._writer is None:
                schema = table.schema.with_metadata(self.about)
                self._writer = self._arrow.parquet.ParquetWriter(self.partial, schema)
            self._writer.write_table(table.cast(self._writer.schema), row_group_size=max(1, table.num_rows))
        except (OSError, self._arrow.ArrowException) as error:
            raise unwritten(self.partial, error) from None
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
                place(self.partial, self.path, self.force)
        except OSError as trouble:
            if kind is None:  # else what ended the run is said, not this
                raise unwritten(self.partial, trouble) from None
