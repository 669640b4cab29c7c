"""Manufacturing errors that a train declares, as fractions of pitch, tooth depth or half angle, and their overrides."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import degrees, pi
from typing import TYPE_CHECKING, Literal

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError, suggest
from geartrain.numerics.quantity import Quantity
from geartrain.teeth.triangular.pair_geometry import depth
from geartrain.workshop.cutting.cut_wheel import displaced
from geartrain.workshop.cutting.wheel_estimate import estimate_measured

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.displaced_contact import DisplacedWheelSizes
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.train import Train, Wheel
    from geartrain.train.manufacturing import AngleError, LengthError, MeasuredTeeth

ErrorDistributionKind = Literal["value", "normal", "uniform"]
OF_WHEELS = ("pitch_deviation", "stepping", "eccentricity", "tip", "aperture_deviation")
OF_PAIRS = ("centre", "bearing")
ERROR_KINDS = (*OF_WHEELS, *OF_PAIRS)
_ANGLES = {"pitch_deviation": "its pitch", "stepping": "its pitch", "aperture_deviation": "its tooth angle"}
"""Name of the nominal angle by which an angular error is divided, keyed by kind of error."""
_OF_PITCHES = ("pitch_deviation", "stepping", "eccentricity")
"""Kinds of errors that are included in the measured angles of the teeth of a wheel."""
MOST = {kind: 1.0 if kind in _ANGLES else 2.0 for kind in ERROR_KINDS}
"""Exclusive upper limits of errors as fractions of pitch, half angle or depth. At the limit, no tooth remains."""


@dataclass(frozen=True, slots=True)
class ErrorSpecification:
    """Distribution of an error that is a fraction of a nominal value."""

    size: float = 0.0
    """Fixed error ("value"), standard deviation ("normal") or half of the width ("uniform") of the distribution [1]."""
    way: ErrorDistributionKind = "value"


@dataclass(frozen=True, slots=True)
class ErrorOverride:
    """Error that replaces the declared errors of the same kind."""

    kind: str
    way: ErrorDistributionKind
    amount: Quantity
    of: str = ""
    """Name of the wheel or pair that has the error; an empty string for all wheels or pairs."""


@dataclass(frozen=True, slots=True)
class WheelErrors:
    """Manufacturing errors of one wheel.

    Pitch deviations and errors of stepping are fractions of the pitch, deviations of the aperture are fractions of the
    half angle of a tooth, and lengths are fractions of the tooth depth.

    half_angle  half angle of the teeth of the perfect wheel (rad)
    errors      distributions of the errors, keyed by kind
    towards     direction of the eccentricity from the first tooth (rad); None for a random direction
    tables      measured values of all teeth, keyed by kind of error; a single value for an eccentricity
    displaced   sizes of the wheel if its errors are modelled as displaced flanks; None for triangular teeth
    ring        True for an internal wheel
    """

    name: str
    z: int
    half_angle: float
    errors: Mapping[str, ErrorSpecification] = field(default_factory=dict)
    towards: float | None = None
    tables: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    displaced: DisplacedWheelSizes | None = None
    ring: bool = False

    @property
    def pitch(self) -> float:
        """Nominal angular pitch [rad]."""
        return 2 * pi / self.z

    @property
    def depth(self) -> float:
        """Tooth depth, the unit of errors that are lengths.

        It is in tip radii for triangular teeth, and in modules (bevel gears: rad) for all other teeth.
        """
        return self.displaced.depth if self.displaced else abs(depth(-self.z if self.ring else self.z, self.half_angle))

    @property
    def true(self) -> bool:
        """True if the wheel is free of errors."""
        return not self.tables and not any(each.size for each in self.errors.values())

    @property
    def angle_radius(self) -> float:
        """Radius of the points of the teeth whose angles are measured [unit of `depth`].

        It is the tip radius of triangular teeth and the pitch radius of all other teeth.
        """
        return self.z / (2 * self.displaced.modules) if self.displaced else 1.0


def read_error_overrides(texts: Iterable[str]) -> tuple[ErrorOverride, ...]:
    """Parse strings that specify cutting and mounting errors, which replace the declared errors of a train.

    Parameters
    ----------
    texts : iterable of str
        Strings `KIND=SIZE` for all or `NAME.KIND=SIZE` for one wheel or pair, such as `pitch_deviation=4.13 %` or
        `m2.eccentricity=value 0.2 mm`. SIZE is the standard deviation of a normal distribution, unless it is preceded
        by `value` or `uniform`.

    Returns
    -------
    tuple of ErrorOverride
        Overrides for `find_trial_plan`.

    Raises
    ------
    QuestionError
        If a string does not contain a kind of error and its size, or if the size of a random error is negative.

    Examples
    --------
    >>> (error,) = read_error_overrides(["m2.eccentricity=value 0.2 mm"])
    >>> error.of, error.kind, error.way, error.amount.text
    ('m2', 'eccentricity', 'value', '0.2 mm')
    """
    return tuple(_setting(text) for text in texts)


def _setting(text: str) -> ErrorOverride:
    from pydantic_core import PydanticCustomError

    key, sign, said = text.partition("=")
    of, _, kind = key.strip().rpartition(".")
    if not sign or kind not in ERROR_KINDS:
        fix = f"write KIND=SIZE or NAME.KIND=SIZE; KIND is one of {', '.join(ERROR_KINDS)}"
        why = "an error is specified by its kind and its size, such as 'tip=3 %'"
        raise QuestionError(Problem(f"'{text}' is not a valid error specification", why, fix))
    # errors quoted without a distribution are usually standard deviations
    way: ErrorDistributionKind = "normal"
    for each in ("value", "normal", "uniform"):
        if said.strip().startswith(f"{each} "):
            way, said = each, said.strip().removeprefix(each)
    try:
        unit = "angle or fraction" if kind in _ANGLES else "length or fraction"
        amount = Quantity.parse(said.strip(), unit, plain=True)
    except PydanticCustomError as error:
        fix = str((error.context or {}).get("fix", "give a size"))
        raise QuestionError(Problem(f"'{text}' is not a valid error specification", error.message(), fix)) from None
    if way != "value" and amount.value < 0:
        what = f"the size in '{text}' is negative"
        why = "the standard deviation or half width of a distribution is 0 or more"
        fix = f"give a positive size, or a fixed error: {kind}='value {said.strip()}'"
        raise QuestionError(Problem(what, why, fix))
    if kind == "stepping" and way == "value":
        why = "the even division of the gap removes an error that all steps share"
        fix = f"give a standard deviation: stepping='{said.strip()}'"
        raise QuestionError(Problem(f"the error in '{text}' is fixed", why, fix))
    return ErrorOverride(kind, way, amount, of)


def check_names(settings: Sequence[ErrorOverride], wheels: Sequence[str], pairs: Sequence[str]) -> None:
    """Raise `QuestionError` if an override names a wheel or pair that is not in the trials."""
    for each in settings:
        known = wheels if each.kind in OF_WHEELS else pairs
        if each.of and each.of not in known:
            part = "wheel" if each.kind in OF_WHEELS else "pair"
            what = f"the error '{each.kind}' is given for the {part} '{each.of}', which is not in the trials"
            why = f"'{each.kind}' applies only to a {part} with triangular teeth or with a known path of contact"
            raise QuestionError(Problem(what, why, suggest(each.of, known)))


def wheel_errors(train: Train, even: WheelErrors, settings: Sequence[ErrorOverride]) -> WheelErrors:
    """Return the wheel `even` with its declared errors. Errors declared for the train apply if none are declared for
    the wheel, and `settings` overrides both.

    Raises `RangeError` if an error is larger than a tooth, or is a length that cannot be converted to a fraction.
    """
    name = even.name
    link, wheel = train.wheels[name]
    own = wheel.cutting is not None
    cutting = wheel.cutting if own else train.cutting
    where = ("links", link, "wheels", name, "cutting") if own else ("cutting",)
    reader = _Reader(train.place(*where), name, _scales(even, wheel))
    errors = {kind: reader.off(kind, getattr(cutting, kind, None)) for kind in OF_WHEELS}
    measured: MeasuredTeeth | None = getattr(cutting, "measured", None)
    by_angles = measured if measured is not None and measured.angles is not None else None
    for each in settings:
        if by_angles is not None and each.kind in _OF_PITCHES:
            if each.of == name:
                what = f"the error '{each.kind}' is given for '{name}', whose angles are measured"
                why, fix = "the measured angles contain it already", f"omit it, or remove `measured` from '{name}'"
                raise QuestionError(Problem(what, why, fix))
        elif each.kind in OF_WHEELS and each.of in ("", name):
            errors[each.kind] = reader.set(each)
    # errors of size 0 are removed, so that a perfect wheel is recognised as such
    errors = {kind: off for kind, off in errors.items() if off.size}
    reader.check(errors)
    at = cutting.eccentricity_angle if cutting is not None else None
    # the declared angle is positive ahead, but teeth are counted in the order they pass, which is backwards
    columns: Mapping[str, Sequence[Quantity]] = {} if measured is None else measured.columns
    tables = {kind: tuple(reader.fraction(kind, each) for each in column) for kind, column in columns.items()}
    found = replace(even, errors=errors, towards=-at.si if at else None, tables=tables)
    return found if by_angles is None else _with_measured_angles(found, by_angles)


def _with_measured_angles(wheel: WheelErrors, measured: MeasuredTeeth) -> WheelErrors:
    """Return the wheel with pitch deviations and eccentricity estimated from the measured angles of its teeth.

    Each unmeasured tooth is assumed to have only the fitted eccentricity if that is significant, and no error if it is
    not.
    """
    found = estimate_measured(measured, wheel.z)
    depth = wheel.depth / wheel.angle_radius
    if measured.use == "law":
        kind = "stepping" if found.law == "stepped" else "pitch_deviation"
        law = {kind: ErrorSpecification(found.cutting_deviation / wheel.pitch, "normal")}
        if found.eccentric:
            law["eccentricity"] = ErrorSpecification(found.eccentricity.value / depth)
        return replace(wheel, errors={**wheel.errors, **law}, towards=None)
    size, direction = found.fitted if found.eccentric else (0.0, 0.0)
    _, eccentric = displaced(
        np.ones(wheel.z),
        np.linspace(0, wheel.z * wheel.pitch, wheel.z, endpoint=False),
        np.array(size),
        np.array(direction),
    )
    behind, tables = eccentric.copy(), dict(wheel.tables)
    behind[found.numbers] = found.off
    if measured.use == "eccentric" and found.eccentric:
        behind -= eccentric
        tables["eccentricity"] = (size / depth,)
    # measured angles are positive behind, declared deviations ahead
    tables["pitch_deviation"] = tuple((-behind / wheel.pitch).tolist())
    return replace(wheel, towards=direction, tables=tables)


def pair_errors(
    train: Train, mesh: GearMesh, lesser: WheelErrors, settings: Sequence[ErrorOverride]
) -> tuple[dict[str, ErrorSpecification], float]:
    """Return the errors of the axes of a pair, keyed by kind, and the depth of one stroke of the file.

    Both are fractions of the tooth depth of `lesser`, the wheel of the pair with the smaller tooth depth. The stroke is
    0 if the pair is not filed to fit.
    """
    fitting = mesh.gear.fitting or train.fitting
    reader = _Reader(mesh.place, mesh.name, _scales(lesser, train.wheels[lesser.name][1]))
    errors = {kind: reader.off(kind, getattr(fitting, kind, None)) for kind in OF_PAIRS}
    for each in settings:
        if each.kind in OF_PAIRS and each.of in ("", mesh.name):
            errors[each.kind] = reader.set(each)
    reader.check(errors)
    filing = fitting.filing if fitting is not None else None
    stroke = reader.fraction("stroke", filing.stroke) if filing is not None else 0.0
    return {kind: off for kind, off in errors.items() if off.size}, stroke


def _scales(even: WheelErrors, wheel: Wheel) -> dict[str, float | None]:
    """Return the angle [rad] or length [m] by which each kind of error is divided; None for an unknown length."""
    deep = None
    module = wheel.transverse_module
    if module is not None:
        if even.displaced is not None:
            deep = even.depth * even.displaced.modules * module
        else:
            # the pitch circle is halfway down the tooth
            half = even.depth / 2
            deep = even.depth * module * even.z / 2 / (1 + half if even.ring else 1 - half)
    # the aperture is the whole angle of a tooth, so its unit is twice the half angle
    lengths: dict[str, float | None] = dict.fromkeys(("eccentricity", "tip", "centre", "bearing", "stroke"), deep)
    lengths |= {"pitch_deviation": even.pitch, "stepping": even.pitch, "aperture_deviation": 2 * even.half_angle}
    return lengths


@dataclass(frozen=True, slots=True)
class _Reader:
    """Converter of declared errors (angles and lengths) of one wheel or pair to fractions of nominal values.

    place    place in the declaration, for error messages
    name     name of the wheel or pair
    scales   angle (rad) or length (m) by which each kind of error is divided
    """

    place: str
    name: str
    scales: Mapping[str, float | None]

    def fraction(self, kind: str, amount: Quantity) -> float:
        if amount.dimension in (None, "fraction"):
            return float(amount.base)
        scale = self.scales[kind]
        if scale is None:
            what = f"the {kind} error of '{self.name}' is the length {amount.text}, but its tooth depth is unknown"
            why = "a length is converted to a fraction of the tooth depth, which needs a module with a unit"
            fix = "declare `module: 0.5 mm` for the wheel, or give the error as a fraction of the depth, such as 3 %"
            raise RangeError(Problem(what, why, fix, self.place))
        return amount.si / scale

    def off(self, kind: str, error: AngleError | LengthError | None) -> ErrorSpecification:
        for way in ("value", "normal", "uniform"):
            amount = getattr(error, way, None)
            if amount is not None:
                return ErrorSpecification(self.fraction(kind, amount), way)
        return ErrorSpecification()

    def set(self, setting: ErrorOverride) -> ErrorSpecification:
        return ErrorSpecification(self.fraction(setting.kind, setting.amount), setting.way)

    def check(self, errors: Mapping[str, ErrorSpecification]) -> None:
        for kind, off in errors.items():
            if abs(off.size) >= MOST[kind]:  # also for random errors: one standard deviation must leave a tooth
                of = _ANGLES.get(kind, "the depth of its teeth")
                what = f"the {kind} error of '{self.name}' is {abs(off.size):.3g} times {of}"
                pitch = self.scales["pitch_deviation"] or 0
                why = (
                    f"the factor must be below {MOST[kind]:g}, otherwise the tooth vanishes; the angular pitch is "
                    f"{degrees(pitch):.3g} deg"
                )
                raise RangeError(Problem(what, why, f"give a smaller error, such as {kind}='2 %'", self.place))
