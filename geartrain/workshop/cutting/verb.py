"""Command `geartrain inspect wheels`: estimate the errors of wheels from measured angles of their teeth."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

from geartrain.cli.common import File, Force, Json, Out, give, sink
from geartrain.errors import Problem, QuestionError
from geartrain.report.document import Document, Section, Table
from geartrain.workshop.cutting.wheel_estimate import estimate_measured
from geartrain.workshop.monte_carlo.monte_carlo_report import angle_text, number_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from geartrain.train import Train, Wheel
    from geartrain.workshop.cutting.wheel_estimate import WheelEstimate


def run(file: File, json: Json = False, out: Out = None, force: Force = False) -> None:
    """Estimate the eccentricities and pitch deviations of wheels from measured angles of their teeth.

    Example: `geartrain inspect wheels measured-wheel`.
    """
    from geartrain.analysis.gear_train import load

    to = sink(out, force, (".md", ".html", ".json"))
    train = load(file).declaration
    found = find_measured_wheels(train)
    give(to, json, lambda: found, lambda: [describe_measured_wheels(train, found)])


def find_measured_wheels(train: Train) -> dict[str, WheelEstimate]:
    """Return the estimates of all wheels with measured angles, by wheel. Raises `QuestionError` if there are none."""
    cut = {name: (wheel.count, wheel.cutting.measured) for name, (_, wheel) in train.wheels.items() if wheel.cutting}
    found = {name: estimate_measured(each, z) for name, (z, each) in cut.items() if z and each and each.angles}
    if not found:
        what = f"no wheel of '{train.name}' has measured angles"
        why = "eccentricity and pitch deviations are estimated from the measured angles of teeth"
        raise QuestionError(Problem(what, why, "declare `cutting: {measured: {csv: FILE}}` for a wheel"))
    return found


def describe_measured_wheels(train: Train, found: Mapping[str, WheelEstimate]) -> Document:
    """Return the report on the measured wheels of a train."""
    summary = (
        "Eccentricities are fractions of the radius at which the angles were measured. Directions are from the first "
        "tooth to later teeth. Intervals are at the 95 % confidence level."
    )
    sections = [_section(name, each, train.wheels[name][1]) for name, each in found.items()]
    return Document(f"Measured wheels: {train.name}", [summary], sections)


def _section(name: str, found: WheelEstimate, wheel: Wheel) -> Section:
    test = f"F = {found.F:.3g} with 2 and {found.measured - 3} degrees of freedom, p = {found.p:.2g}"
    ratio = f"von Neumann's ratio {found.q:.3g}, 5 % point of independent deviations {found.q_limit:.3g}"
    none = f"No eccentricity was found, less than {found.detectable:.3g} ({test})."
    independent = f"The deviations of the teeth appear independent ({ratio})."
    key, of = ("stepping", "a step") if found.law == "stepped" else ("pitch_deviation", "a tooth")
    law = f"{key}: {{normal: {degrees(found.cutting_deviation):.4g} deg}}"
    rows = [
        (f"sd of {of} (deg)", angle_text(found.deviation), f"{degrees(found.deviation_error):.3g}"),
        (f"sd of {of} without measurement error (deg)", f"{degrees(found.cutting_deviation):.3g}", ""),
    ]
    if found.eccentric:
        rows += [
            ("eccentricity / radius", number_text(found.eccentricity), f"{found.eccentricity_error:.3g}"),
            ("direction (deg)", angle_text(found.direction), f"{degrees(found.direction_error):.3g}"),
        ]
        if (module := wheel.transverse_module) is not None:
            law += f", eccentricity: {found.eccentricity.value * 500 * module * found.teeth:.4g} mm"
    texts = (
        f"{found.measured} of {found.teeth} teeth were measured.",
        f"The wheel is eccentric ({test})." if found.eccentric else none,
        f"Neighbouring teeth deviate together, as in division by stepping ({ratio})." if found.stepped else independent,
        "Other wheels of the same maker, with the eccentricity of angles that were measured at the pitch circle:",
        f"`cutting: {{{law}}}`",
    )
    return Section(name, texts, (Table(("quantity", "estimate", "standard error"), rows),))
