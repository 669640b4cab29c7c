"""From a train's answers to a document, and from a document to Markdown, HTML or a terminal."""

from __future__ import annotations

from geartrain.report.comparing import compare_trains
from geartrain.report.content import report_train
from geartrain.report.data import train_data
from geartrain.report.document import Aside, Document, Picture, Section, Table
from geartrain.report.meshing import Running, mesh_document
from geartrain.report.moving import motion_data, motion_document
from geartrain.report.paging import to_html
from geartrain.report.pins import pin_data, pin_document
from geartrain.report.power import flow_of, there_and_back, torques_data, torques_document
from geartrain.report.rendering import to_markdown, to_terminal
from geartrain.report.shapes import shape_data, shape_document
from geartrain.report.shapes_compared import Compared, Shaped, compared_data, compared_document
from geartrain.report.sharing import shared_document
from geartrain.report.sphere import (
    SphereAnswers,
    sphere_data,
    sphere_document,
    suggestions_data,
    suggestions_document,
    survey_document,
)
from geartrain.report.sweep import sweep_data, sweep_document, sweep_rows
from geartrain.report.synthesis import (
    approximants_document,
    assignment_rows,
    assignments_document,
    kinds_document,
    orrery_document,
    orrery_rows,
    pairs_document,
    set_row,
    sets_document,
    stages_document,
    stages_row,
)
from geartrain.report.teeth import mesh_data
from geartrain.report.trials import trials_data, trials_document

__all__ = [
    "Aside",
    "Compared",
    "Document",
    "Picture",
    "Running",
    "Section",
    "Shaped",
    "SphereAnswers",
    "Table",
    "approximants_document",
    "assignment_rows",
    "assignments_document",
    "compare_trains",
    "compared_data",
    "compared_document",
    "flow_of",
    "kinds_document",
    "mesh_data",
    "mesh_document",
    "motion_data",
    "motion_document",
    "orrery_document",
    "orrery_rows",
    "pairs_document",
    "pin_data",
    "pin_document",
    "report_train",
    "set_row",
    "sets_document",
    "shape_data",
    "shape_document",
    "shared_document",
    "sphere_data",
    "sphere_document",
    "stages_document",
    "stages_row",
    "suggestions_data",
    "suggestions_document",
    "survey_document",
    "sweep_data",
    "sweep_document",
    "sweep_rows",
    "there_and_back",
    "to_html",
    "to_markdown",
    "to_terminal",
    "torques_data",
    "torques_document",
    "train_data",
    "trials_data",
    "trials_document",
]
