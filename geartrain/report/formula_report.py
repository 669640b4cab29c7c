"""Outputs as formulas in tooth counts, as a page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.kinematics.formulas.speed_formulas import OutputFormula, speed_formulas
from geartrain.numerics.results import Result
from geartrain.report.document import Document, Section, Table, exact

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.kinematics.formulas.closed_forms import ClosedForm

_HEAD = "z_NAME stands for the tooth count of the wheel NAME, and the name of a link for its speed."


@dataclass(frozen=True)
class RatioElasticity(Result):
    """How a tooth count changes a ratio."""

    state: str | None
    """The state."""
    output: str
    """Output of the ratio."""
    input: str
    """Input of the ratio."""
    wheel: str
    """Wheel whose tooth count varies."""
    elasticity: ClosedForm
    """(z/f) df/dz: by how many per cent the ratio grows where the count grows by one per cent."""


@dataclass(frozen=True)
class FormulaReport(Result):
    """Formulas of outputs, in each state that was asked for.

    See Also
    --------
    describe_formulas : Its page.
    """

    PAGE = "report.formula_report:describe_formulas"

    name: str
    """Name of the train."""
    title: str
    """Title of the train."""
    formulas: tuple[OutputFormula, ...]
    """State by state."""
    sensitivities: tuple[RatioElasticity, ...] = ()
    """Of all counts, where they were asked for."""


def collect_formulas(
    train: GearTrain, states: Sequence[str | None], outputs: Sequence[str] = (), sensitivities: bool = False
) -> FormulaReport:
    """The formulas of a train in some states, to be told.

    Parameters
    ----------
    train : GearTrain
        The train.
    states : sequence of str or None
        States; None of a train that has none.
    outputs : sequence of str
        Some outputs; by default all.
    sensitivities : bool
        With all elasticities.

    Returns
    -------
    FormulaReport
        Without outputs that the inputs do not determine.

    Examples
    --------
    >>> import geartrain
    >>> found = collect_formulas(geartrain.load("wolfrom-175"), [None], ["arm"], sensitivities=True)
    >>> [(each.wheel, each.elasticity.text) for each in found.sensitivities]
    [('s12', 'z_r72/(z_s12 + z_r72)'), ('r72', '-z_r72/(z_s12 + z_r72)')]
    """
    formulas = tuple(each for state in states for each in _formulas(train, state, outputs))
    found = (
        RatioElasticity(each.state, each.output, share.input, wheel, share.ratio.elasticity(wheel))
        for each in formulas
        for share in each.shares
        for wheel in share.ratio.formula.wheels
    )
    return FormulaReport(train.name, train.declaration.title, formulas, tuple(found) if sensitivities else ())


def _formulas(train: GearTrain, state: str | None, outputs: Sequence[str] = ()) -> Iterator[OutputFormula]:
    """Those of some outputs, by default of all that the inputs determine."""
    return speed_formulas(train.declaration, train.declaration.single_state(state), outputs)


def describe_formulas(found: FormulaReport, latex: bool = False, inverse: bool = False) -> Document:
    """Each output with its formula, its value, and where it locks; elasticities where they were asked for.

    Parameters
    ----------
    found : FormulaReport
        Formulas of a train.
    latex : bool
        Formulas as LaTeX.
    inverse : bool
        Ratios as input over output too.

    Returns
    -------
    Document
        Speeds in the train's unit.

    Examples
    --------
    >>> import geartrain
    >>> train = geartrain.load("planetary-24-18-60")
    >>> page = describe_formulas(collect_formulas(train, [None]))
    >>> page.sections[0].paragraphs[1]
    'carrier = z_s/(z_s + z_ring) · sun = 2/7'
    """
    states = dict.fromkeys(each.state for each in found.formulas)
    sections = [section for state in states for section in _state(found, state, latex, inverse)]
    return Document(f"Formulas of {found.name}", (), tuple(sections))


def formula_section(train: GearTrain, state: str | None, explained: bool = True) -> Iterator[Section]:
    """What a report tells: the formulas of one state, without outputs that are inputs themselves.

    explained   with the words that say how a formula is read
    """
    told = [each for each in _formulas(train, state) if any(share.ratio.formula.wheels for share in each.shares)]
    if told:
        lines = (text for each in told for text in _lines(each, False))
        yield Section(_title(state), ((_HEAD,) if explained else ()) + tuple(lines))


def _state(found: FormulaReport, state: str | None, latex: bool, inverse: bool) -> Iterator[Section]:
    formulas = [each for each in found.formulas if each.state == state]
    lines = [text for each in formulas for text in _lines(each, latex)]
    if inverse:
        lines += [text for each in formulas for text in _inverse(each, latex)]
    yield Section(_title(state), (_HEAD, *lines))
    rows = [_row(each, latex) for each in found.sensitivities if each.state == state]
    if rows:
        text = "By how many per cent a ratio grows where a count grows by one per cent, (z/f) df/dz."
        table = Table(("output/input", "wheel", "sensitivity", "here"), rows)
        yield Section("Sensitivities" if state is None else f"State {state}: sensitivities", (text,), (table,))


def _title(state: str | None) -> str:
    return "Formulas" if state is None else f"State {state}: formulas"


def _lines(each: OutputFormula, latex: bool) -> Iterator[str]:
    value = "not determined at these counts" if each.value is None else str(exact(each.value))
    written = each.latex if latex else each.text
    yield f"{written} = {value}" if each.shares else written  # a speed of 0 is not told twice
    for condition in each.conditions:
        yield f"It turns only if {condition}."
    for pole in each.poles:
        yield f"'{each.output}' is locked, or free, if {pole}."


def _inverse(each: OutputFormula, latex: bool) -> Iterator[str]:
    if len(each.shares) == 1 and each.shares[0].ratio.formula.wheels:
        ratio = each.shares[0].ratio.inverse
        value = "infinite" if ratio.value is None else str(exact(ratio.value))
        yield f"{each.shares[0].input}/{each.output} = {ratio.latex if latex else ratio.text} = {value}"
        for pole in ratio.poles:
            yield f"'{each.output}' stands still if {pole}."


def _row(each: RatioElasticity, latex: bool) -> tuple[str, ...]:
    found = each.elasticity
    value = "-" if found.value is None else str(exact(found.value))
    return f"{each.output}/{each.input}", each.wheel, found.latex if latex else found.text, value
