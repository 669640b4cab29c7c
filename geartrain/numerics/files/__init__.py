"""Atomic output of files, tables in CSV and Parquet format, and input of points and edges."""

from __future__ import annotations

from geartrain.numerics.files.atomic import check_folder, destination, write_bytes, write_folder, write_text
from geartrain.numerics.files.tabular import (
    ColumnTable,
    LongTable,
    csv_line,
    csv_lines,
    csv_text,
    partial_name,
    read_edges,
    read_points,
)

__all__ = [
    "ColumnTable",
    "LongTable",
    "check_folder",
    "csv_line",
    "csv_lines",
    "csv_text",
    "destination",
    "partial_name",
    "read_edges",
    "read_points",
    "write_bytes",
    "write_folder",
    "write_text",
]
