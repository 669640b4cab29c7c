"""The only door to disk: YAML in, with line marks and `extends` merged; finished text out, atomically."""

from __future__ import annotations

from geartrain.files.declaring import as_yaml
from geartrain.files.loading import load, read_declaration, shipped
from geartrain.files.long import LongTable, partial_name
from geartrain.files.outlines import OUTLINES, outline_text, write_outline
from geartrain.files.tables import read_edges, read_points
from geartrain.files.writing import write_bytes, write_text

__all__ = [
    "OUTLINES",
    "LongTable",
    "as_yaml",
    "load",
    "outline_text",
    "partial_name",
    "read_declaration",
    "read_edges",
    "read_points",
    "shipped",
    "write_bytes",
    "write_outline",
    "write_text",
]
