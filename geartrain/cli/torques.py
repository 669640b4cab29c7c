"""`geartrain torques`: torques, flow of power, losses, self-locking."""

from __future__ import annotations

import typer

from geartrain.cli.common import GOOD, VERDICT, File, Json, Out, StateName, as_json, emit, show, suffix_of


def run(file: File, state: StateName = None, json: Json = False, out: Out = None) -> None:
    """Torques on links and pairs under the declared loads, flow of power and losses, efficiency there and back."""
    from geartrain import report
    from geartrain.files import load

    suffix = suffix_of(out, (".md", ".html", ".json"))
    train = load(file)
    states = (state,) if state is not None else train.states or (None,)
    found = {name: train.torques(name) for name in states}
    sound = all(each.verdict or each.verdict.kind == "unloaded" for each in found.values())
    if json or suffix == ".json":
        data = [report.torques_data(train, each) for each in found.values()]
        emit(as_json(data[0] if len(data) == 1 else {"states": {str(each["state"]): each for each in data}}), out)
    else:
        show([report.torques_document(train, list(found.values()))], out, suffix)
    raise typer.Exit(GOOD if sound else VERDICT)
