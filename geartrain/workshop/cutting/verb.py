"""Command `geartrain inspect wheels`: estimates from the measured angles of the teeth of wheels."""

from __future__ import annotations

from geartrain.cli.common import File, Force, Json, Out, give, sink


def run(file: File, json: Json = False, out: Out = None, force: Force = False) -> None:
    """Estimate the eccentricities and pitch deviations of wheels from measured angles of their teeth.

    Example: `geartrain inspect wheels measured-wheel`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.workshop.cutting.wheel_report import describe_measured_wheels, find_measured_wheels

    to = sink(out, force, (".md", ".html", ".json"))
    train = load(file).declaration
    found = find_measured_wheels(train)
    give(to, json, lambda: found, lambda: [describe_measured_wheels(train, found)])
