"""A page on several conjugate tooth forms beside the 20 degree involute."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite, pi
from typing import TYPE_CHECKING, Any

from geartrain.report.conjugate_pair_page import FREE, LOADED, cost, finite, measures_data, pair_name
from geartrain.report.document import Document, Section, Table

if TYPE_CHECKING:
    from geartrain.errors import Problem
    from geartrain.teeth.conjugate.path_costs import PathMeasures
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.pair_verdict import ToothFault

_LOADED = ("loss", "stress", "stress off pitch", "heat", "flash")
_FREE = ("depth", "contact ratio", "slowest")


@dataclass(frozen=True)
class MeasuredForm:
    """One form of a comparison: its path and measures, or why it cannot run."""

    name: str
    path: PathOfContact | None
    measures: PathMeasures | None
    faults: tuple[ToothFault | Problem, ...] = ()

    @property
    def runs(self) -> bool:
        """True if teeth of this form can run."""
        return self.measures is not None and not self.faults


@dataclass(frozen=True)
class FormComparison:
    """Forms beside the 20 degree involute of the same pair and arcs.

    matched   what all have in common, in words
    """

    base: MeasuredForm
    forms: tuple[MeasuredForm, ...]
    matched: str

    @property
    def path(self) -> PathOfContact:
        """The path of the involute."""
        assert self.base.path is not None
        return self.base.path


def compared_document(found: FormComparison) -> Document:
    """Tables of ratios, and what keeps the others from running."""
    from geartrain.teeth.conjugate.path_costs import ONE_PAIR, SHARED

    base = found.base.measures
    assert base is not None
    text = (
        "Ratios to the involute of 20 deg. Loss: of the mean power lost; stress: of the greatest Hertz pressure, "
        "infinite where the pressure angle is 0 at the pitch point, and off pitch where contact is more than a tenth "
        "of a pitch away from it; heat: of the greatest heat of friction per area; flash: of the greatest flash "
        "temperature; depth: of the working depth; slowest: of the least speed of the contact along a dedendum. Arcs: "
        f"approach and recess in pitches. Of loss, stress, heat and flash: {ONE_PAIR}."
    )
    rows = [_ratios(form, base) for form in found.forms]
    sections = [Section("Ratios", (text,), [Table(("form", "arcs", *_LOADED, *_FREE), rows, True)])]
    sections += [_sharing(found, SHARED), _base(found)]
    faulty = [line for form in found.forms for line in _reasons(form)]
    if faulty:
        sections.append(Section("What cannot run", faulty))
    return Document(f"Tooth forms, {pair_name(found.path)}", [found.matched], sections)


def _sharing(found: FormComparison, words: str) -> Section:
    """The same costs where pairs in contact share the load; a sentence where never two touch at once."""
    base = found.base.measures
    assert base is not None
    runs = [form.measures for form in found.forms if form.runs and form.measures]
    if all(each.contact_ratio < 1 + 1e-9 for each in (base, *runs)):
        return Section("Ratios, shared load", ("One pair of teeth touches at a time: sharing changes nothing.",))
    rows = [_shared(form, base) for form in found.forms]
    return Section("Ratios, shared load", (f"As above, where {words}.",), [Table(("form", *_LOADED), rows, True)])


def _shared(form: MeasuredForm, base: PathMeasures) -> tuple[str, ...]:
    if not form.runs or form.measures is None:
        return (form.name, *("-" for _ in LOADED))
    over = form.measures.shared.over(base.shared)
    return (form.name, *(_ratio(over[name]) for name in LOADED))


def _ratios(form: MeasuredForm, base: PathMeasures) -> tuple[str, ...]:
    if form.path is None or form.measures is None or form.faults:
        words = ", ".join(dict.fromkeys(getattr(fault, "kind", "refused") for fault in form.faults))
        return (form.name, _arcs(form.path) if form.path else "-", words, *("-" for _ in (*LOADED, *FREE)[1:]))
    over = form.measures.one_pair.over(base.one_pair)
    free = (getattr(form.measures, name) / getattr(base, name) for name in FREE)
    return (form.name, _arcs(form.path), *(_ratio(over[name]) for name in LOADED), *map(_ratio, free))


def _ratio(value: float) -> str:
    return f"{value:.4f}" if isfinite(value) else "inf"


def _arcs(path: PathOfContact) -> str:
    return " + ".join(f"{arc / path.pitch.p:.4g}" for arc in path.arcs)


def _base(found: FormComparison) -> Section:
    base = found.base.measures
    assert base is not None
    loads = base.one_pair, base.shared
    rows = [(name, *(cost(getattr(each, key)) for each in loads)) for name, key in zip(_LOADED, LOADED, strict=True)]
    rows += [(name, *[cost(getattr(base, key))] * 2) for name, key in zip(_FREE, FREE, strict=True)]
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


def compared_data(found: FormComparison) -> dict[str, Any]:
    """The comparison as plain data; infinite ratios are null."""
    base = found.base.measures
    assert base is not None
    pitch = found.path.pitch
    return {
        "teeth": [pitch.z1, pitch.z2],
        "matched": found.matched,
        "base": {"form": "involute", "pressure_angle": pi / 9} | measures_data(base),
        "forms": [_form_data(form, base) for form in found.forms],
    }


def _form_data(form: MeasuredForm, base: PathMeasures) -> dict[str, Any]:
    data: dict[str, Any] = {"form": form.name, "runs": form.runs, "arcs": None, "ratios": None}
    if form.path is not None:
        data["arcs"] = [arc / form.path.pitch.p for arc in form.path.arcs]
    if form.measures is not None and form.runs:
        data["ratios"] = _finite(form.measures.over(base))
    return data | {"faults": [_fault_data(fault) for fault in form.faults]}


def _finite(ratios: dict[str, Any]) -> dict[str, Any]:
    """Infinite ratios as null, at any depth."""
    return {name: _finite(value) if isinstance(value, dict) else finite(value) for name, value in ratios.items()}


def _fault_data(fault: ToothFault | Problem) -> dict[str, Any]:
    return {
        "kind": getattr(fault, "kind", "refused"),
        "gear": getattr(fault, "gear", 0) or None,
        "what": fault.what,
        "why": fault.why,
        "fix": fault.fix,
    }
