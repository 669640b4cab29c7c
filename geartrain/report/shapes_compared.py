"""A page on several conjugate tooth forms beside the 20 degree involute."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite, pi
from typing import TYPE_CHECKING, Any

from geartrain.report.document import Document, Section, Table
from geartrain.report.shapes import RATIOS, cost, finite, measures_data, pair_name

if TYPE_CHECKING:
    from geartrain.conjugate.admissible import Fault
    from geartrain.conjugate.measures import Measures
    from geartrain.conjugate.path import Path
    from geartrain.errors import Problem

_HEADS = ("loss", "stress", "stress off pitch", "heat", "flash", "depth", "contact ratio", "slowest")


@dataclass(frozen=True)
class Shaped:
    """One form of a comparison: its path and measures, or why it cannot run."""

    name: str
    path: Path | None
    measures: Measures | None
    faults: tuple[Fault | Problem, ...] = ()

    @property
    def runs(self) -> bool:
        """True if teeth of this form can run."""
        return self.measures is not None and not self.faults


@dataclass(frozen=True)
class Compared:
    """Forms beside the 20 degree involute of the same pair and arcs.

    matched   what all have in common, in words
    """

    base: Shaped
    forms: tuple[Shaped, ...]
    matched: str

    @property
    def path(self) -> Path:
        """The path of the involute."""
        assert self.base.path is not None
        return self.base.path


def compared_document(found: Compared) -> Document:
    """A table of ratios, and what keeps the others from running."""
    base = found.base.measures
    assert base is not None
    rows = [_ratios(form, base) for form in found.forms]
    tables = [Table(("form", "arcs", *_HEADS), rows, True)]
    text = (
        "Ratios to the involute of 20 deg. Loss: of the mean power lost; stress: of the greatest Hertz pressure, "
        "infinite where the pressure angle is 0 at the pitch point, and off pitch where contact is more than a tenth "
        "of a pitch away from it; heat: of the greatest heat of friction per area; flash: of the greatest flash "
        "temperature; depth: of the working depth; slowest: of the least speed of the contact along a dedendum. Arcs: "
        "approach and recess in pitches."
    )
    sections = [Section("Ratios", (text,), tables), _base(found)]
    faulty = [line for form in found.forms for line in _reasons(form)]
    if faulty:
        sections.append(Section("What cannot run", faulty))
    return Document(f"Tooth forms, {pair_name(found.path)}", [found.matched], sections)


def _ratios(form: Shaped, base: Measures) -> tuple[str, ...]:
    if form.path is None or form.measures is None or form.faults:
        words = ", ".join(dict.fromkeys(getattr(fault, "kind", "refused") for fault in form.faults))
        return (form.name, _arcs(form.path) if form.path else "-", words, *("-" for _ in RATIOS[1:]))
    over = form.measures.over(base)
    return (form.name, _arcs(form.path), *(_ratio(over[name]) for name in RATIOS))


def _ratio(value: float) -> str:
    return f"{value:.4f}" if isfinite(value) else "inf"


def _arcs(path: Path) -> str:
    return " + ".join(f"{arc / path.pitch.p:.4g}" for arc in path.arcs)


def _base(found: Compared) -> Section:
    base = found.base.measures
    assert base is not None
    rows = [(name, cost(getattr(base, key))) for name, key in zip(_HEADS, RATIOS, strict=True)]
    unit = "rad on the unit sphere" if found.path.pitch.bevel else "modules"
    text = (
        f"The involute itself, lengths in {unit}: mean loss over friction; greatest Hertz pressure as the root of "
        "curvature over cos psi; greatest heat over friction times tangential force."
    )
    return Section("The involute of 20 deg", (text,), (Table(("quantity", "value"), rows),))


def _reasons(form: Shaped) -> Iterator[str]:
    for fault in form.faults:
        words = (fault.what, fault.why, fault.fix)
        yield f"{form.name}: " + "; ".join(word for word in words if word) + "."


def compared_data(found: Compared) -> dict[str, Any]:
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


def _form_data(form: Shaped, base: Measures) -> dict[str, Any]:
    data: dict[str, Any] = {"form": form.name, "runs": form.runs, "arcs": None, "ratios": None}
    if form.path is not None:
        data["arcs"] = [arc / form.path.pitch.p for arc in form.path.arcs]
    if form.measures is not None and form.runs:
        data["ratios"] = {name: finite(value) for name, value in form.measures.over(base).items()}
    return data | {"faults": [_fault_data(fault) for fault in form.faults]}


def _fault_data(fault: Fault | Problem) -> dict[str, Any]:
    return {
        "kind": getattr(fault, "kind", "refused"),
        "gear": getattr(fault, "gear", 0) or None,
        "what": fault.what,
        "why": fault.why,
        "fix": fault.fix,
    }
