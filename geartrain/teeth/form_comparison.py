"""Comparison of conjugate tooth forms with the 20 degree involute of the same wheels and the same arcs of contact.

Forms are compared at equal arcs of contact. The arcs of approach and recess are given, in pitches, and each tooth form
constructs the pair with these arcs. Losses, stresses and temperatures are ratios to the values of the involute.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING, get_args

from geartrain.errors import GearTrainError, Problem, QuestionError, suggest
from geartrain.numerics.results import Key, Pictured, Result
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

USUAL = ("involute", "uniform_stress", "uniform_temperature_b", "least_friction", "cycloidal", "lantern")
"""Names of the tooth forms compared by default, with one variant of each form."""
_MOST_PITCHES = 100.0  # upper limit of an arc of contact
_EIGHTH = 0.125  # turn: from 45 deg on, the pressure angle does not determine teeth of uniform stress


@dataclass(frozen=True)
class MeasuredForm(Result):
    """Result for one compared tooth form: path of contact, losses and loads, or the faults of its teeth."""

    KEYS = (*(Key("form", "name"), "runs", Key("arcs", "pitches"), "ratios", "faults"),)

    name: str
    """Name of the requested tooth form, including the variant, such as `uniform_temperature_b`."""
    path: PathOfContact | None
    """Path of contact; None if the tooth form rejects the wheels."""
    measures: PathMeasures | None
    """Losses and loads of the pair; None if the teeth cannot mesh."""
    ratios: PathRatios | None = None
    """Losses and loads relative to the involute; None for the involute itself and if the teeth cannot run."""
    faults: tuple[ToothFault, ...] = ()
    """Faults that prevent the teeth from running; of kind "refused" if the tooth form rejects the wheels."""

    @property
    def runs(self) -> bool:
        """True if teeth of the compared tooth form can run."""
        return self.measures is not None and not self.faults

    @property
    def pitches(self) -> tuple[float, float] | None:
        """Arcs of approach and recess [pitch]; one arc may be negative. None if `path` is None."""
        return None if self.path is None else self.path.pitches

    @property
    def pressure_angle(self) -> float | None:
        """Pressure angle at the pitch point [rad]; None if `path` is None."""
        return None if self.path is None else float(self.path.at(0.0).psi)


@dataclass(frozen=True)
class FormComparison(Pictured, Result):
    """Comparison of tooth forms with the 20 degree involute of the same wheels and the same arcs of contact."""

    PAGE = "report.conjugate_pair_page:describe_form_comparison"
    FIGURE = "drawing.transmission_curves:comparison_figure"

    KEYS = (
        *("teeth", "matched"),
        Key("base", keys=(Key("form", "name"), "pressure_angle", Key("", "measures"))),
        "forms",
    )

    teeth: tuple[int, int]
    """Tooth numbers of the two wheels."""
    matched: str
    """Text that names the quantities that are equal in all compared pairs."""
    base: MeasuredForm
    """Result for the involute, with which the tooth forms are compared."""
    forms: tuple[MeasuredForm, ...]
    """Results for the compared forms, and for an involute with contact in recess only if a form has such contact."""

    @property
    def path(self) -> PathOfContact:
        """Path of contact of the involute."""
        assert self.base.path is not None
        return self.base.path

    @property
    def measures(self) -> PathMeasures:
        """Losses and loads of the involute."""
        assert self.base.measures is not None
        return self.base.measures


def comparable_forms() -> dict[str, tuple[type[ConjugateToothForm], dict[str, str]]]:
    """Return the class and the parameters of each conjugate tooth form that can be compared, keyed by name.

    A form with several variants (values of `reading`) is listed once with its default variant and once for each
    variant, such as `uniform_temperature_b`.
    """
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
    """Return the loss, stress, heat, flash temperature and depth of tooth forms, each divided by its value for the 20
    degree involute.

    The quantities are defined in docs/shapes.md and computed to first order in friction. The criteria are from W. D.
    Smith (1993).

    Parameters
    ----------
    wheels : WheelPair
        Tooth numbers of the two wheels, and the arrangement of their axes.
    names : sequence of str
        Names of the forms, keys of `comparable_forms`.
    arcs : tuple of float
        Arcs of approach and recess of all forms [pitch], with a sum of 1 or more.
    pressure_angle : Quantity, optional
        Pressure angle of the forms with such a parameter, below 45 deg; by default the default of each form.

    Returns
    -------
    FormComparison
        Results of the involute, and ratios or faults of each form. If a form has contact in recess only, the last
        result is an involute with the same arcs.

    Raises
    ------
    QuestionError
        If a name is unknown, a parameter is invalid, or the involute itself cannot run.

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
    base = _pair_result("involute", Involute.pair_of_arcs(wheels, arcs, {"pressure_angle": "20 deg"}))
    if base.measures is None:
        what = "the 20 deg involute, the reference of the comparison, cannot run: "
        # remedies that change the pressure angle are omitted, because the reference has 20 degrees by definition
        fixes = [f"{fault.fix.partition(', or ')[0]}, or give other tooth numbers" for fault in base.faults]
        faults = zip(base.faults, fixes, strict=True)
        raise QuestionError(Problem(what + fault.what, fault.why, fix, "arcs") for fault, fix in faults)
    found = []
    for name in names:
        model, reading = known[name]
        own = angle if "pressure_angle" in model.model_fields else {}
        try:
            found.append(_pair_result(name, model.pair_of_arcs(wheels, arcs, {**reading, **own}), base.measures))
        except GearTrainError as error:
            refused = (ToothFault("refused", 0, nan, each.what, each.why, each.fix) for each in error.problems)
            found.append(MeasuredForm(name, None, None, faults=tuple(refused)))
    recess = (form.pitches for form in found if form.runs and form.pitches and form.pitches[0] <= 0 < arcs[0])
    if (own_arcs := next(recess, None)) is not None:
        # without this row, an advantage of the arcs would be attributed to the tooth form
        involute = Involute.pair_of_arcs(wheels, own_arcs, angle)
        found.append(_pair_result("involute, recess only", involute, base.measures))
    models = [model for name, (model, _) in known.items() if name in names]
    notes = dict.fromkeys(model.matched for model in models if model.matched)
    common = "; ".join([f"arcs of contact, {arcs[0]:g} pitches in approach and {arcs[1]:g} in recess", *notes])
    loads = "one tooth pair bears the whole load, or the tooth pairs in contact share it"
    matched = f"Matched: {common}. Two loads: {loads}. Results are to first order in friction."
    return FormComparison((int(wheels.z1), int(wheels.z2)), matched, base, tuple(found))


def arcs_error(text: str) -> QuestionError:
    """Return the error for arcs of contact that are out of range; `text` is the declared arcs."""
    why = f"arcs of approach and recess are numbers from 0 to {_MOST_PITCHES:g}, and not both 0"
    fix = "give two arcs in pitches with a sum of 1 or more, such as 0.5,0.5"
    return QuestionError(Problem(f"arcs of {text} are not valid", why, fix, "arcs"))


def _check(
    known: Mapping[str, object], names: Sequence[str], arcs: tuple[float, float], angle: Quantity | None
) -> None:
    if not names:
        raise QuestionError(Problem("no tooth form is given", "", f"give one or more of: {', '.join(known)}"))
    for name in names:
        if name not in known:
            fix = suggest(name, list(known), otherwise=f"give one or more of: {', '.join(known)}", wide=True)
            raise QuestionError(
                Problem(f"'{name}' is not a tooth form that can be compared", "only conjugate forms are compared", fix)
            )
    if not 0 <= min(arcs) <= max(arcs) <= _MOST_PITCHES or sum(arcs) <= 0:
        raise arcs_error(",".join(f"{arc:g}" for arc in arcs))
    if angle is not None and not 0 < angle.base < _EIGHTH:
        why = "a pressure angle of 45 deg or more does not determine teeth of uniform stress"
        fix = "give an angle between 0 and 45 deg, such as 20 deg"
        raise QuestionError(Problem(f"a pressure angle of {angle.text} is out of range", why, fix, "pressure_angle"))


def _pair_result(name: str, pair: ConjugatePair, base: PathMeasures | None = None) -> MeasuredForm:
    from geartrain.teeth.conjugate.path_losses import measure

    if pair.faults:
        return MeasuredForm(name, pair.path, None, faults=pair.faults)
    found = measure(pair.path)
    return MeasuredForm(name, pair.path, found, None if base is None else found.over(base))
