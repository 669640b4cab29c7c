"""The only door to disk: YAML in, with line marks and `extends` merged; finished text out, atomically."""

from __future__ import annotations

from geartrain.files.columns import ColumnTable
from geartrain.files.declaring import as_yaml
from geartrain.files.folder import check_folder, write_folder
from geartrain.files.loading import load, read_declaration, shipped
from geartrain.files.long import LongTable, partial_name
from geartrain.files.separated import csv_line, csv_lines, csv_text
from geartrain.files.tables import read_edges, read_points
from geartrain.files.writing import destination, write_bytes, write_text

__all__ = [
    "ColumnTable",
    "LongTable",
    "as_yaml",
    "check_folder",
    "csv_line",
    "csv_lines",
    "csv_text",
    "destination",
    "load",
    "partial_name",
    "read_declaration",
    "read_edges",
    "read_points",
    "shipped",
    "write_bytes",
    "write_folder",
    "write_text",
]
