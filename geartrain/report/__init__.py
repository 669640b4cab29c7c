"""From a train's answers to a document, and from a document to Markdown, HTML or a terminal."""

from __future__ import annotations

from geartrain.report.comparing import compare_trains
from geartrain.report.content import report_train
from geartrain.report.data import train_data
from geartrain.report.document import Document, Section, Table
from geartrain.report.rendering import to_html, to_markdown, to_terminal

__all__ = [
    "Document",
    "Section",
    "Table",
    "compare_trains",
    "report_train",
    "to_html",
    "to_markdown",
    "to_terminal",
    "train_data",
]
