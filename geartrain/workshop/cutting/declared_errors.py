"""Which errors a train declares, as plain fractions of pitch, depth and half angle; and errors set in their place."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import degrees, pi
from typing import TYPE_CHECKING, Literal

from geartrain.errors import Problem, QuestionError, RangeError, suggest
from geartrain.numerics.quantity import Quantity
from geartrain.teeth.triangular.pair_geometry import depth

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.displaced_contact import DisplacedWheelSizes
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.train import PairMounting, Train, Wheel, WheelManufacture
    from geartrain.train.manufacturing import AngleError, LengthError

ErrorDistributionKind = Literal["value", "normal", "uniform"]
OF_WHEELS = ("pitch_deviation", "eccentricity", "tip", "aperture_deviation")
OF_PAIRS = ("centre", "bearing")
ERROR_KINDS = (*OF_WHEELS, *OF_PAIRS)
MOST = {
    "pitch_deviation": 1.0,
    "aperture_deviation": 1.0,
    "tip": 2.0,
    "eccentricity": 2.0,
    "centre": 2.0,
    "bearing": 2.0,
}
"""Sizes beyond which there is no tooth left, as fractions of pitch, half angle and depth."""


@dataclass(frozen=True, slots=True)
class ErrorSpecification:
    """One error: fixed at `size`, or drawn with the standard deviation or the greatest size `size` (a fraction)."""

    size: float = 0.0
    way: ErrorDistributionKind = "value"

    def times(self, factor: float) -> ErrorSpecification:
        """The same error, greater or smaller."""
        return replace(self, size=self.size * factor)


@dataclass(frozen=True, slots=True)
class ErrorOverride:
    """An error set by hand in place of what is declared: `text` of one kind, of one wheel or pair or of all."""

    kind: str
    way: ErrorDistributionKind
    amount: Quantity
    of: str = ""


@dataclass(frozen=True, slots=True)
class WheelErrors:
    """How one wheel is cut.

    pitch, half_angle  of the even wheel (rad); `depth` of its teeth over the radius of its tips
    ring               its teeth are inside
    errors             by kind: pitch_deviation in pitches, aperture in half angles, the others in depths
    towards            where its middle lies from the axle, from the first tooth (rad); None for anywhere
    tables             measured tooth by tooth, by kind, in the same fractions
    displaced          sizes of teeth whose flanks are displaced along their path of contact; None for triangular teeth
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
        """Even pitch (rad)."""
        return 2 * pi / self.z

    @property
    def depth(self) -> float:
        """Depth of a tooth over the radius of the tips; of displaced flanks in modules, or rad on cones."""
        return self.displaced.depth if self.displaced else abs(depth(-self.z if self.ring else self.z, self.half_angle))

    @property
    def true(self) -> bool:
        """True if nothing of it is off."""
        return not self.tables and not any(each.size for each in self.errors.values())


def read_error_overrides(texts: Iterable[str]) -> tuple[ErrorOverride, ...]:
    """Errors of cutting and fitting set by hand, in place of those that a train declares.

    Parameters
    ----------
    texts : iterable of str
        `KIND=SIZE` or `NAME.KIND=SIZE`, of all or of one wheel or pair: `pitch_deviation=4.13 %`,
        `m2.eccentricity=value 0.2 mm`. The error is normally distributed and SIZE is its standard deviation,
        unless `value` or `uniform` precedes it.

    Returns
    -------
    tuple of ErrorOverride
        For `find_trial_plan`.

    Raises
    ------
    QuestionError
        For a text that names no kind of error, or no size.

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
        fix = f"write KIND=SIZE or NAME.KIND=SIZE, with one of {', '.join(ERROR_KINDS)}"
        raise QuestionError(Problem(f"'{text}' sets no error", "it names no kind of error and its size", fix))
    way: ErrorDistributionKind = "normal"
    for each in ("value", "normal", "uniform"):
        if said.strip().startswith(f"{each} "):
            way, said = each, said.strip().removeprefix(each)
    try:
        unit = "angle or fraction" if kind in ("pitch_deviation", "aperture_deviation") else "length or fraction"
        amount = Quantity.parse(said.strip(), unit, plain=True)
    except PydanticCustomError as error:
        fix = str((error.context or {}).get("fix", "give a size"))
        raise QuestionError(Problem(f"'{text}' sets no error", error.message(), fix)) from None
    if way != "value" and amount.value < 0:
        raise QuestionError(Problem(f"'{text}': no width of a distribution", "it is below 0", "write it 0 or greater"))
    return ErrorOverride(kind, way, amount, of)


def check_names(settings: Sequence[ErrorOverride], wheels: Sequence[str], pairs: Sequence[str]) -> None:
    """Raise `QuestionError` where an error is set on what the train does not have, or has not cut."""
    for each in settings:
        known = wheels if each.kind in OF_WHEELS else pairs
        if each.of and each.of not in known:
            what = f"no {'wheel' if each.kind in OF_WHEELS else 'pair'} '{each.of}' has teeth that are cut by hand"
            raise QuestionError(Problem(what, f"its {each.kind} cannot be set", suggest(each.of, known)))


def wheel_errors(train: Train, even: WheelErrors, settings: Sequence[ErrorOverride]) -> WheelErrors:
    """The errors of one wheel: its own or the train's, then what is set. Raises `RangeError` beyond its tooth."""
    name = even.name
    link, wheel = train.wheels[name]
    own = wheel.cutting is not None
    cutting = wheel.cutting if own else train.cutting
    where = ("links", link, "wheels", name, "cutting") if own else ("cutting",)
    reader = _Reader(train.place(*where), name, _scales(even, wheel))
    errors = {kind: reader.off(kind, getattr(cutting, kind, None)) for kind in OF_WHEELS}
    for each in settings:
        if each.kind in OF_WHEELS and each.of in ("", name):
            errors[each.kind] = reader.set(each)
    errors = {kind: off for kind, off in errors.items() if off.size}
    reader.check(errors)
    at = cutting.eccentricity_angle if cutting is not None else None
    # declared ahead, as placement is; teeth are counted as they pass, which is behind
    return replace(even, errors=errors, towards=-at.si if at else None, tables=reader.tables(cutting))


def pair_errors(
    train: Train, mesh: GearMesh, lesser: WheelErrors, settings: Sequence[ErrorOverride]
) -> dict[str, ErrorSpecification]:
    """The errors of the axes of a pair, in depths of the less deep teeth, those of the wheel `lesser`."""
    fitting = mesh.gear.fitting or train.fitting
    reader = _pair_reader(train, mesh, lesser)
    errors = {kind: reader.off(kind, getattr(fitting, kind, None)) for kind in OF_PAIRS}
    for each in settings:
        if each.kind in OF_PAIRS and each.of in ("", mesh.name):
            errors[each.kind] = reader.set(each)
    reader.check(errors)
    return {kind: off for kind, off in errors.items() if off.size}


def filing_stroke(train: Train, mesh: GearMesh, lesser: WheelErrors) -> float:
    """What one stroke of the file takes, in depths of the less deep teeth; 0 where nothing is filed to fit."""
    fitting = mesh.gear.fitting or train.fitting
    filing = fitting.filing if fitting is not None else None
    return _pair_reader(train, mesh, lesser).fraction("stroke", filing.stroke) if filing is not None else 0.0


def _pair_reader(train: Train, mesh: GearMesh, lesser: WheelErrors) -> _Reader:
    return _Reader(mesh.place, mesh.name, _scales(lesser, train.wheels[lesser.name][1]))


def _scales(even: WheelErrors, wheel: Wheel) -> dict[str, float | None]:
    """What one of a fraction is: of an angle (rad), and of a length (m; None where no module says how great)."""
    deep = None
    module = wheel.transverse_module
    if module is not None:
        if even.displaced is not None:
            deep = even.depth * even.displaced.modules * module
        else:
            # the pitch circle lies half way down the tooth
            half = even.depth / 2
            deep = even.depth * module * even.z / 2 / (1 + half if even.ring else 1 - half)
    lengths: dict[str, float | None] = dict.fromkeys(("eccentricity", "tip", "centre", "bearing", "stroke"), deep)
    return {"pitch_deviation": even.pitch, "aperture_deviation": 2 * even.half_angle, **lengths}


@dataclass(frozen=True, slots=True)
class _Reader:
    """Reads errors of one wheel or pair as fractions."""

    place: str
    name: str
    scales: Mapping[str, float | None]

    def fraction(self, kind: str, amount: Quantity) -> float:
        if amount.dimension in (None, "fraction"):
            return float(amount.base)
        scale = self.scales[kind]
        if scale is None:
            why = "a length says something of a tooth whose size is known, and no module is declared with a unit"
            fix = "give the module of the wheel, or the error as a fraction of the depth"
            raise RangeError(Problem(f"{kind} of '{self.name}': {amount.text} of what?", why, fix, self.place))
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
            if abs(off.size) >= MOST[kind]:
                of = {"pitch_deviation": "its pitch", "aperture_deviation": "its aperture"}.get(
                    kind, "the depth of its teeth"
                )
                what = f"the {kind} error of '{self.name}' is {abs(off.size):.3g} of {of}"
                minimum = self.scales["pitch_deviation"] or 0
                why = f"an error greater than the tooth leaves none; the pitch is {degrees(minimum):.3g} deg"
                raise RangeError(Problem(what, why, "give an error smaller than the tooth", self.place))

    def tables(self, cutting: WheelManufacture | PairMounting | None) -> dict[str, tuple[float, ...]]:
        measured = getattr(cutting, "measured", None)
        if measured is None:
            return {}
        columns: Mapping[str, Sequence[Quantity]] = measured.columns
        return {kind: tuple(self.fraction(kind, each) for each in column) for kind, column in columns.items()}
