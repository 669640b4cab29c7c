"""Comparison of conjugate tooth forms with the 20 degree involute of the same wheels and the same arcs of contact.

Forms are comparable where they are in contact equally long: arcs of approach and recess are given, in pitches, and each
form makes the pair that has them. Costs are ratios to those of the involute.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING, get_args

from geartrain.errors import GearTrainError, Problem, QuestionError, suggest
from geartrain.numerics.results import Key, Result
from geartrain.teeth.any_tooth_form import tooth_forms
from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm
from geartrain.teeth.involute import Involute
from geartrain.teeth.pair_results import ToothFault

if TYPE_CHECKING:
    from geartrain.numerics.quantity import Quantity
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
    from geartrain.teeth.conjugate.path_losses import PathMeasures, PathRatios
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.conjugate.wheel_pair import WheelPair

REFERENCE_ANGLE = "20 deg"
"""Pressure angle of the involute with which forms are compared."""
USUAL = ("involute", "uniform_stress", "uniform_temperature_b", "least_friction", "cycloidal", "lantern")
"""Forms that are compared where none are named: one reading of each."""
_MOST_PITCHES = 100.0  # of an arc
_EIGHTH = 0.125  # turn: from 45 deg on teeth of uniform stress are no longer determined by their pressure angle


@dataclass(frozen=True)
class MeasuredForm(Result):
    """One form of a comparison: its path and measures, or why it cannot run."""

    KEYS = (*(Key("form", "name"), "runs", Key("arcs", "pitches"), "ratios", "faults"),)

    name: str
    """As it was asked for, with its reading."""
    path: PathOfContact | None
    measures: PathMeasures | None
    ratios: PathRatios | None = None
    """Measures over those of the involute; None for teeth that cannot run."""
    faults: tuple[ToothFault, ...] = ()
    """Why they cannot; of kind "refused" where the form gives no such pair."""

    @property
    def runs(self) -> bool:
        """True if teeth of this form can run."""
        return self.measures is not None and not self.faults

    @property
    def pitches(self) -> tuple[float, float] | None:
        """Arcs of approach and recess in pitches, one of which may be negative; None without a path."""
        if self.path is None:
            return None
        approach, recess = self.path.arcs
        return approach / self.path.pitch.p, recess / self.path.pitch.p

    @property
    def pressure_angle(self) -> float | None:
        """At the pitch point (rad); None without a path."""
        return None if self.path is None else float(self.path.at(0.0).psi)


@dataclass(frozen=True)
class FormComparison(Result):
    """Forms beside the 20 degree involute of the same pair and arcs."""

    PAGE = "report.conjugate_pair_page:describe_form_comparison"

    KEYS = (
        *("teeth", "matched"),
        Key("base", keys=(Key("form", "name"), "pressure_angle", Key("", "measures"))),
        "forms",
    )

    teeth: tuple[int, int]
    """Of the two wheels."""
    matched: str
    """What all have in common, in words."""
    base: MeasuredForm
    """The involute itself."""
    forms: tuple[MeasuredForm, ...]
    """The forms that are compared."""

    @property
    def path(self) -> PathOfContact:
        """The path of the involute."""
        assert self.base.path is not None
        return self.base.path

    @property
    def measures(self) -> PathMeasures:
        """What the involute costs."""
        assert self.base.measures is not None
        return self.base.measures


def comparable_forms() -> dict[str, tuple[type[ConjugateToothForm], dict[str, str]]]:
    """What can be compared, by name: a conjugate form, and the reading of it where it has several."""
    found: dict[str, tuple[type[ConjugateToothForm], dict[str, str]]] = {}
    for name, model in tooth_forms().items():
        if not issubclass(model, ConjugateToothForm):
            continue
        found[name] = model, {}
        readings = get_args(model.model_fields["reading"].annotation) if "reading" in model.model_fields else ()
        found |= {f"{name}_{reading}": (model, {"reading": reading}) for reading in readings}
    return found


def compare_forms(
    wheels: WheelPair,
    names: Sequence[str] = USUAL,
    arcs: tuple[float, float] = (0.5, 0.5),
    pressure_angle: Quantity | None = None,
) -> FormComparison:
    """Loss, stress, heat, flash and depth of forms as ratios to those of the 20 degree involute.

    Costs are those of docs/shapes.md, to first order in friction; the criteria are W. D. Smith's (1993).

    Parameters
    ----------
    wheels : WheelPair
        Tooth numbers of the two, and how their axes stand.
    names : sequence of str
        Of `comparable_forms`.
    arcs : tuple of float
        Of approach and recess, matched by all [pitch]; together 1 or more.
    pressure_angle : Quantity, optional
        Of the forms that have one, below 45 deg; by default as each declares it.

    Returns
    -------
    FormComparison
        The involute, and each form with its ratios or what keeps it from running.

    Raises
    ------
    QuestionError
        For unknown names and wrong parameters, and where the involute itself cannot run.

    Examples
    --------
    >>> from geartrain.teeth.conjugate import WheelPair
    >>> (form,) = compare_forms(WheelPair(24, 36), ["least_friction"]).forms
    >>> form.runs, form.ratios.one_pair["loss"] < 1
    (True, True)
    """
    known = comparable_forms()
    _check(known, names, arcs, pressure_angle)
    angle = {} if pressure_angle is None else {"pressure_angle": pressure_angle.text}
    base = _measured("involute", reference_involute(wheels, arcs))
    if base.measures is None:
        raise _no_base(base)
    found = [_form(name, *known[name], wheels, arcs, angle, base.measures) for name in names]
    found += _beside(found, wheels, arcs, angle, base.measures)
    models = [model for name, (model, _) in known.items() if name in names]
    return FormComparison((int(wheels.z1), int(wheels.z2)), _matched(models, arcs), base, tuple(found))


def reference_involute(wheels: WheelPair, arcs: tuple[float, float]) -> ConjugatePair:
    """The 20 degree involute with these arcs of approach and recess (pitches), whatever addenda they take."""
    return Involute.pair_of_arcs(wheels, arcs, {"pressure_angle": REFERENCE_ANGLE})


def arcs_error(text: str) -> QuestionError:
    """What is said of arcs that no pair can have."""
    fix = "give those of approach and recess in pitches, such as 0.5,0.5; together 1 or more"
    return QuestionError(Problem(f"arcs {text} are none", "", fix, "--arcs"))


def _check(
    known: Mapping[str, object], names: Sequence[str], arcs: tuple[float, float], angle: Quantity | None
) -> None:
    """Raise `QuestionError` for what cannot be compared."""
    if not names:
        raise QuestionError(Problem("no form is named", "", f"use some of: {', '.join(known)}", "--forms"))
    for name in names:
        if name not in known:
            fix = suggest(name, list(known), otherwise=f"use some of: {', '.join(known)}", wide=True)
            raise QuestionError(Problem(f"there is no tooth form '{name}' to compare", "", fix, "--forms"))
    if not 0 <= min(arcs) <= max(arcs) <= _MOST_PITCHES or sum(arcs) <= 0:
        raise arcs_error(",".join(f"{arc:g}" for arc in arcs))
    if angle is not None and not 0 < angle.base < _EIGHTH:
        why = "at 45 deg and above teeth of uniform stress are no longer determined by it"
        fix = "give one between 0 and 45 deg; 20 deg is usual"
        raise QuestionError(Problem(f"a pressure angle of {angle.text} is out of range", why, fix, "--pressure-angle"))


def _no_base(base: MeasuredForm) -> QuestionError:
    """What keeps the involute with which forms are compared from running; its pressure angle is not to choose."""
    what = "the 20 deg involute, with which forms are compared, cannot run: "
    fixes = (fault.fix.partition(", or ")[0] for fault in base.faults)
    return QuestionError(
        Problem(what + fault.what, fault.why, f"{fix}, or give other teeth", "--arcs")
        for fault, fix in zip(base.faults, fixes, strict=True)
    )


def _form(
    name: str,
    model: type[ConjugateToothForm],
    reading: Mapping[str, str],
    wheels: WheelPair,
    arcs: tuple[float, float],
    angle: Mapping[str, str],
    base: PathMeasures,
) -> MeasuredForm:
    """One form with these arcs, or what refuses them."""
    own = angle if "pressure_angle" in model.model_fields else {}
    try:
        return _measured(name, model.pair_of_arcs(wheels, arcs, {**reading, **own}), base)
    except GearTrainError as error:
        refused = (ToothFault("refused", 0, nan, each.what, each.why, each.fix) for each in error.problems)
        return MeasuredForm(name, None, None, faults=tuple(refused))


def _beside(
    found: Sequence[MeasuredForm],
    wheels: WheelPair,
    arcs: tuple[float, float],
    angle: Mapping[str, str],
    base: PathMeasures,
) -> Iterator[MeasuredForm]:
    """For a form that works in recess only, the involute with its arcs: it tells what is due to these."""
    for form in found:
        if form.runs and form.pitches is not None and form.pitches[0] <= 0 < arcs[0]:
            yield _measured("involute, recess only", Involute.pair_of_arcs(wheels, form.pitches, angle), base)
            return


def _measured(name: str, pair: ConjugatePair, base: PathMeasures | None = None) -> MeasuredForm:
    from geartrain.teeth.conjugate.path_losses import measure

    if pair.faults:
        return MeasuredForm(name, pair.path, None, faults=pair.faults)
    found = measure(pair.path)
    return MeasuredForm(name, pair.path, found, None if base is None else found.over(base))


def _matched(models: Sequence[type[ConjugateToothForm]], arcs: tuple[float, float]) -> str:
    """What all pairs have in common, in words."""
    notes = dict.fromkeys(model.matched for model in models if model.matched)
    common = "; ".join([f"arcs, {arcs[0]:g} pitches of approach and {arcs[1]:g} of recess", *notes])
    loads = "one pair of teeth bears all, or those in contact share it; first order in friction"
    return f"Matched: {common}. Two loads: {loads}."
