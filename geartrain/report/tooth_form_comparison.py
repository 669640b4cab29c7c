"""A page on several conjugate tooth forms beside the 20 degree involute."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite
from typing import TYPE_CHECKING

from geartrain.report.conjugate_pair_page import cost, pair_name
from geartrain.report.document import Document, Section, Table
from geartrain.teeth.conjugate.path_costs import FREE, LOADED, ONE_PAIR, SHARED

if TYPE_CHECKING:
    from geartrain.teeth.form_comparison import FormComparison, MeasuredForm

_HEADERS = {"off_pitch": "stress off pitch"}


def describe_form_comparison(found: FormComparison) -> Document:
    """A page on tooth forms beside the 20 degree involute: tables of ratios, and what keeps forms from running.

    Parameters
    ----------
    found : FormComparison
        What `geartrain.teeth.form_comparison.compare_forms` gives; its `to_dict()` has the same as data.

    Returns
    -------
    Document
        Ratios where one pair of teeth bears the load, and where pairs in contact share it; the involute itself.

    Examples
    --------
    >>> from geartrain.teeth.conjugate import WheelPair
    >>> from geartrain.teeth.form_comparison import compare_forms
    >>> page = describe_form_comparison(compare_forms(WheelPair(24, 36), ["involute", "cycloidal"]))
    >>> [row[:4] for row in page.sections[0].tables[0].rows]
    [('involute', '0.5 + 0.5', '1.0000', '1.0000'), ('cycloidal', '0.5 + 0.5', '1.0021', 'inf')]
    """
    text = (
        "Ratios to the involute of 20 deg. Loss: of the mean power lost; stress: of the greatest Hertz pressure, "
        "infinite where the pressure angle is 0 at the pitch point, and off pitch where contact is more than a tenth "
        "of a pitch away from it; heat: of the greatest heat of friction per area; flash: of the greatest flash "
        "temperature; depth: of the working depth; slowest: of the least speed of the contact along a dedendum. Arcs: "
        f"approach and recess in pitches. Of loss, stress, heat and flash: {ONE_PAIR}."
    )
    rows = [_ratios(form) for form in found.forms]
    header = ("form", "arcs", *map(_header, (*LOADED, *FREE)))
    sections = [Section("Ratios", (text,), [Table(header, rows, True)]), _sharing(found), _base(found)]
    faulty = [line for form in found.forms for line in _reasons(form)]
    if faulty:
        sections.append(Section("What cannot run", faulty))
    return Document(f"Tooth forms, {pair_name(found.path)}", [found.matched], sections)


def _header(name: str) -> str:
    """What a column of this measure is called."""
    return _HEADERS.get(name, name.replace("_", " "))


def _sharing(found: FormComparison) -> Section:
    """The same costs where pairs in contact share the load; a sentence where never two touch at once."""
    base = found.measures
    runs = [form.measures for form in found.forms if form.runs and form.measures]
    if all(each.contact_ratio < 1 + 1e-9 for each in (base, *runs)):
        return Section("Ratios, shared load", ("One pair of teeth touches at a time: sharing changes nothing.",))
    rows = [_shared(form) for form in found.forms]
    table = Table(("form", *map(_header, LOADED)), rows, True)
    return Section("Ratios, shared load", (f"As above, where {SHARED}.",), [table])


def _shared(form: MeasuredForm) -> tuple[str, ...]:
    if form.ratios is None:
        return (form.name, *("-" for _ in LOADED))
    return (form.name, *(_ratio(form.ratios.shared[name]) for name in LOADED))


def _ratios(form: MeasuredForm) -> tuple[str, ...]:
    if form.ratios is None:
        words = ", ".join(dict.fromkeys(fault.kind for fault in form.faults))
        return (form.name, _arcs(form), words, *("-" for _ in (*LOADED, *FREE)[1:]))
    loaded, free = form.ratios.one_pair, form.ratios.free
    return (form.name, _arcs(form), *(_ratio(loaded[name]) for name in LOADED), *(_ratio(free[name]) for name in FREE))


def _ratio(value: float) -> str:
    return f"{value:.4f}" if isfinite(value) else "inf"


def _arcs(form: MeasuredForm) -> str:
    return "-" if form.pitches is None else " + ".join(f"{arc:.4g}" for arc in form.pitches)


def _base(found: FormComparison) -> Section:
    base = found.measures
    loads = base.one_pair, base.shared
    rows = [(_header(name), *(cost(getattr(each, name)) for each in loads)) for name in LOADED]
    rows += [(_header(name), *[cost(getattr(base, name))] * 2) for name in FREE]
    unit = "rad on the unit sphere" if found.path.pitch.bevel else "modules"
    text = (
        f"The involute itself, lengths in {unit}: mean loss over friction; greatest Hertz pressure as the root of "
        "curvature over cos psi; greatest heat over friction times tangential force."
    )
    return Section("The involute of 20 deg", (text,), (Table(("quantity", "one pair", "shared"), rows),))


def _reasons(form: MeasuredForm) -> Iterator[str]:
    for fault in form.faults:
        words = (fault.what, fault.why, fault.fix)
        yield f"{form.name}: " + "; ".join(word for word in words if word) + "."
