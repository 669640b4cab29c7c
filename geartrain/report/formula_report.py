"""Document on outputs as formulas in tooth counts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.kinematics.formulas.speed_formulas import OutputFormula, speed_formulas
from geartrain.numerics.results import Result
from geartrain.report.couplings import VaryingCoupling, varying_couplings, varying_section
from geartrain.report.document import Document, Section, Table, exact, titled

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.kinematics.formulas.closed_forms import ClosedForm

_HEAD = "z_NAME is the tooth count of the wheel NAME; the name of a link denotes its speed."


@dataclass(frozen=True)
class RatioElasticity(Result):
    """Elasticity of a speed ratio with respect to a tooth count."""

    state: str | None
    """Name of the state; None if the train has no states."""
    output: str
    """Name of the output whose speed is the numerator of the ratio."""
    input: str
    """Name of the input whose speed is the denominator of the ratio."""
    wheel: str
    """Name of the wheel whose tooth count is varied."""
    elasticity: ClosedForm
    """Elasticity (z/f) df/dz of the ratio f with respect to the tooth count z."""


@dataclass(frozen=True)
class FormulaReport(Result):
    """Formulas of the outputs of a train in each requested state."""

    PAGE = "report.formula_report:describe_formulas"

    name: str
    """Name of the train."""
    title: str
    """Title of the train."""
    formulas: tuple[OutputFormula, ...]
    """Formulas of the outputs in each requested state."""
    sensitivities: tuple[RatioElasticity, ...] = ()
    """Elasticities of each ratio with respect to each tooth count; empty if they are not requested."""
    couplings: tuple[VaryingCoupling, ...] = ()
    """Couplings with a variable ratio. The formulas contain the mean ratios of these couplings."""


def collect_formulas(
    train: GearTrain, states: Sequence[str | None], outputs: Sequence[str] = (), sensitivities: bool = False
) -> FormulaReport:
    """Return the formulas of a train's outputs in the given states."""
    declared = train.declaration
    given = (declared.single_state(state) for state in states)
    formulas = tuple(each for state in given for each in speed_formulas(declared, state, outputs))
    found = (
        RatioElasticity(each.state, each.output, share.input, wheel, share.ratio.elasticity(wheel))
        for each in formulas
        for share in each.shares
        for wheel in share.ratio.formula.wheels
    )
    elasticities, varying = tuple(found) if sensitivities else (), tuple(varying_couplings(train))
    return FormulaReport(train.name, declared.title, formulas, elasticities, varying)


def describe_formulas(found: FormulaReport, latex: bool = False, inverse: bool = False) -> Document:
    """Return a document with formula, value, locking condition and any elasticities of each output."""
    states = dict.fromkeys(each.state for each in found.formulas)
    sections = [section for state in states for section in _state(found, state, latex, inverse)]
    sections += [varying_section(found.couplings)] if found.couplings else []
    return Document(f"Formulas of {found.name}", (), tuple(sections))


def formula_section(train: GearTrain, state: str | None, explained: bool = True) -> Iterator[Section]:
    """Yield a section with the formulas of one state that contain tooth counts; yield nothing if there are no such
    formulas.

    explained   True to begin the section with an explanation of the notation
    """
    formulas = speed_formulas(train.declaration, train.declaration.single_state(state))
    # a formula without tooth counts would only repeat a given speed
    shown = [each for each in formulas if any(share.ratio.formula.wheels for share in each.shares)]
    if shown:
        lines = (text for each in shown for text in _lines(each, False))
        yield Section(titled(state, "formulas"), ((_HEAD,) if explained else ()) + tuple(lines))


def _state(found: FormulaReport, state: str | None, latex: bool, inverse: bool) -> Iterator[Section]:
    formulas = [each for each in found.formulas if each.state == state]
    lines = [text for each in formulas for text in _lines(each, latex)]
    if inverse:
        lines += [text for each in formulas for text in _inverse(each, latex)]
    yield Section(titled(state, "formulas"), (_HEAD, *lines))
    rows = [_row(each, latex) for each in found.sensitivities if each.state == state]
    if rows:
        text = "Sensitivity (z/f) df/dz: change of the ratio in per cent if the tooth count increases by one per cent."
        table = Table(("output/input", "wheel", "sensitivity", "value"), rows)
        yield Section(titled(state, "sensitivities"), (text,), (table,))


def _lines(each: OutputFormula, latex: bool) -> Iterator[str]:
    value = "not determined at these counts" if each.value is None else str(exact(each.value))
    written = each.latex if latex else each.text
    yield f"{written} = {value}" if each.shares else written  # without shares the formula is already `output = 0`
    for condition in each.conditions:
        yield f"It turns only if {condition}."
    for pole in each.poles:
        yield f"'{each.output}' is locked, or free, if {pole}."


def _inverse(each: OutputFormula, latex: bool) -> Iterator[str]:
    if len(each.shares) == 1 and each.shares[0].ratio.formula.wheels:
        ratio = each.shares[0].ratio.inverse
        # the output is at rest, so the inverse ratio has no value
        value = "infinite" if ratio.value is None else str(exact(ratio.value))
        yield f"{each.shares[0].input}/{each.output} = {ratio.latex if latex else ratio.text} = {value}"
        for pole in ratio.poles:
            yield f"'{each.output}' is at rest if {pole}."


def _row(each: RatioElasticity, latex: bool) -> tuple[str, ...]:
    found = each.elasticity
    value = "-" if found.value is None else str(exact(found.value))
    return f"{each.output}/{each.input}", each.wheel, found.latex if latex else found.text, value
