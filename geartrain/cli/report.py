"""`geartrain report`: structure, circuits, mobility, speeds, outputs, targets and doubts."""

from __future__ import annotations

import typer

from geartrain.cli.common import GOOD, VERDICT, Files, Json, Out, as_json, emit, load_all, show, suffix_of


def run(files: Files, out: Out = None, json: Json = False) -> None:
    """Report on trains: Markdown to the terminal, or by the suffix of -o as .md, .html or .json."""
    from geartrain import report

    suffix = suffix_of(out, (".md", ".html", ".json"))
    trains = load_all(files)
    sound = all(answer for train in trains for answer in train.answers())
    sound = sound and not any(mesh.fault for train in trains for mesh in train.meshes)
    if json or suffix == ".json":
        data = [report.train_data(train) for train in trains]
        emit(as_json(data[0] if len(data) == 1 else data), out)
    else:
        show([report.report_train(train) for train in trains], out, suffix)
    raise typer.Exit(GOOD if sound else VERDICT)
