"""Results as documents: on a terminal, as Markdown, as one HTML page, and as JSON.

A function `describe_...` converts a result to a `Document`, titled sections of paragraphs and tables, which `to_text`,
`to_markdown` and `to_html` convert to text. The result's method `to_dict` returns its data as JSON (docs/json.md).

document             `Document`, sections, tables, and their layout within a width
text, html_page      conversion of a document to Markdown, terminal text and HTML
json_schema          JSON Schema of all answers
declaration_schema   JSON Schema of the declaration, and the reference of its keys
train_data           `TrainReport`, the contents of a report; `train_report` describes it, also as a page to share
answers              speeds, outputs and targets; `soundness` has the findings of `check`
formula_report       outputs as formulas in tooth counts
gearbox_report       a train with clutches in all its states
gear_pairs           real teeth and pins of a train
couplings            sizes of other couplings, and what is not modelled
torque_report        torques, power flow, losses; torque over some turns
motion_report        anomalies and transmission errors
pair_page            one pair of wheels without a train; `conjugate_pair_page` has conjugate forms and their comparison
reconstruction_comparison, spherical_report, accuracy_report   several trains; gears on a sphere; error against run time

Optional packages contain their own reports.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.report.document import Branch as Branch
    from geartrain.report.document import Document as Document
    from geartrain.report.document import Picture as Picture
    from geartrain.report.document import Section as Section
    from geartrain.report.document import Table as Table
    from geartrain.report.html_page import to_html as to_html
    from geartrain.report.text import to_markdown as to_markdown
    from geartrain.report.text import to_text as to_text
    from geartrain.report.train_data import TrainReport as TrainReport
    from geartrain.report.train_data import collect_report as collect_report

__getattr__, __all__ = public_names(
    __name__,
    {
        "document": "Branch Document Picture Section Table",
        "html_page": "to_html",
        "text": "to_markdown to_text",
        "train_data": "TrainReport collect_report",
    },
)
