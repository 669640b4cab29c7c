"""From a train's answers to a document, and from a document to Markdown, HTML or a terminal."""

from __future__ import annotations

from geartrain.report.conjugate_pair_page import shape_data, shape_document
from geartrain.report.document import Document, PageExtras, Picture, Section, Table
from geartrain.report.gear_pairs import mesh_data
from geartrain.report.html_page import to_html
from geartrain.report.monte_carlo_report import trials_data, trials_document
from geartrain.report.motion_report import motion_data, motion_document
from geartrain.report.pair_page import Running, mesh_document, pin_data, pin_document
from geartrain.report.posterior_report import sweep_data, sweep_document, sweep_rows
from geartrain.report.power_report import flow_of, there_and_back, torques_data, torques_document
from geartrain.report.reconstructions_compared import compare_trains
from geartrain.report.shared_page import shared_document
from geartrain.report.spherical_report import (
    SphereAnswers,
    sphere_data,
    sphere_document,
    suggestions_data,
    suggestions_document,
    survey_document,
)
from geartrain.report.text import to_markdown, to_terminal
from geartrain.report.tooth_forms_compared import FormComparison, MeasuredForm, compared_data, compared_document
from geartrain.report.tooth_numbers import (
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
from geartrain.report.train_report import report_train, train_data

__all__ = [
    "Document",
    "FormComparison",
    "MeasuredForm",
    "PageExtras",
    "Picture",
    "Running",
    "Section",
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
