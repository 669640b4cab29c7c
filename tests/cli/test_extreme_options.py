"""Every option that takes a number, with numbers nobody means: a right answer or a refusal with what to do."""

from __future__ import annotations

import json
import signal
import warnings
from collections.abc import Callable, Iterator
from contextlib import chdir, contextmanager
from math import inf, nan, pi
from pathlib import Path
from types import FrameType

import numpy as np
import pytest
from commands import call
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from sampling import few_or_many

import geartrain
from geartrain.dynamics import MotionRun
from geartrain.errors import GearTrainError
from geartrain.teeth import PinToSlotTransmission, SlotToPinTransmission
from geartrain.teeth.transmission import TransmissionFunction
from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

PLAIN = ("0", "-0", "-1", "1", "0.5", "3.7", "1e-300", "-1e-300", "1e-9", "1e9", "1e17", "1e300", "-1e300", "1e999")
PLAIN += ("nan", "inf", "-inf", "9" * 25, "", " ", "1/0", "x", "1,1", "1,", "1:2:3")
UNITS = {"angle": "deg", "length": "mm", "torque": "N m", "speed": "turn/s", "inertia": "kg m2", "number": ""}
SECONDS = 60

PAIR = """
name: pair
links: {frame: {}, a: {wheels: {x: {teeth: 48, module: 1 mm}}}, b: {wheels: {y: {teeth: 96, module: 1 mm}}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [x, y], friction: 0.1, tooth_form: {form: triangular, half_angle: 30 deg, clearance_factor: 1.01}}]
frame: frame
inputs: {a: 1}
outputs: {b: }
"""

CONJUGATE = {
    "involute": ("pressure_angle:angle", "shift", "addendum", "dedendum", "centre_distance", "backlash"),
    "cycloidal": ("rolling", "addendum", "arcs"),
    "lantern": ("pin_diameter", "pin_radius", "arcs", "addendum", "pins"),
    "uniform_stress": ("pressure_angle:angle", "arcs"),
    "uniform_temperature": ("heat", "depth", "minimum_angle:angle", "arcs"),
    "least_friction": ("pressure_angle:angle", "margin", "arcs"),
}
SHARED = ("friction", "shaft-angle:angle", "driver", "module:length")
OUTLINED = tuple(f"blank={key}:length" for key in ("clearance", "fillet", "bore", "rim", "tolerance"))
OUTLINED += ("wheel", "module:length")

# commands without the option, and the options of each kind; {pair} is a small train, {out} a folder that is new
CASES = [
    *(
        (("mesh", "24", "36", "--form", form, *more), (*(f"p={key}" for key in own), *SHARED))
        for form, own in CONJUGATE.items()
        for more in ((), ("--friction", "0.1"))
    ),
    *(
        (("mesh", "24", "36", "--form", form, "--module", "1mm", "--profile", "{out}/w.svg"), OUTLINED)
        for form in ("involute", "lantern")
    ),
]
for _line in """
mesh 48 96 --form triangular | p=half_angle:angle p=clearance_factor p=excess p=window p=backlash p=centre_distance
mesh 48 96 --form triangular | p=radii driver
mesh 48 96 --form triangular -p clearance_factor=1.01 | p=half_angle:angle module:length friction p=radii
mesh 48 96 --form triangular -p clearance_factor=1.01 --module 2mm --rate 1turn/s --load 1N*m | inertia:inertia
mesh 48 96 --form triangular -p clearance_factor=1.01 --module 2mm --inertia 1kg*m2 --load 1N*m | rate:speed
mesh 48 96 --form triangular -p clearance_factor=1.01 --module 2mm --inertia 1kg*m2 --rate 1turn/s | load:torque
mesh 48 96 --form triangular -p clearance_factor=1.01 --plot {out}/t.svg | at:angle
pin 10 | value value:length
pin 10 5 | friction driver
pin 10 12 --driver slot | friction
mesh 24 36 --compare | p=arcs p=pressure_angle:angle shaft-angle:angle form
motion {pair} --samples 40 | turns seed phases output
motion {pair} --samples 40 --turns 3 --spectrum | turns
motion {pair} --turns 3 | samples:few
montecarlo {pair} --trials 4 | seed set clearance workers:few
montecarlo {pair} | trials:few
budget {pair} --samples 40 --trials 4 | turns span seed output cutting body
budget {pair} --turns 3 | samples:few
posterior {pair} --free x=47:49 | tolerance scale most limit samples:few seed free
teeth ratio 5.25 | stages range wheels pinions tolerance best most-total
teeth set 5.25 --kind simple | planets clearance ratio-is best tolerance mode pick shift
teeth orrery a=3.2 b=7.1 | effort walk tolerance best range
sphere cube | teeth radius suggest best
draw {pair} -o {out}/d.svg | turns
export {pair} --to {out}/e --as svg | module:length thickness:length bore:length sheet
export {pair} --to {out}/e --as svg | backlash:length turns
export planetary-24-18-60 --to {out}/e --as svg --module 1mm | backlash:length
""".strip().splitlines():
    _base, _, _options = _line.partition(" | ")
    CASES.append((tuple(_base.split()), tuple(_options.split())))


@contextmanager
def bounded(seconds: int) -> Iterator[None]:
    """Whoever does not answer in time is endless."""

    def stop(_: int, __: FrameType | None) -> None:
        raise TimeoutError(f"no answer within {seconds} s")

    old = signal.signal(signal.SIGALRM, stop)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, old)


def judge(arguments: list[str]) -> str:
    """What is wrong with the answer of the command; empty if it answers, or refuses in the way of a user."""
    with warnings.catch_warnings(record=True) as caught, bounded(SECONDS):
        warnings.simplefilter("always")
        done = call(*arguments)
    found = done.exception
    if isinstance(found, GearTrainError):
        lame = [problem for problem in found.problems if not problem.what or not problem.fix]
        return f"no way out of: {lame[0].what}" if lame else ""
    if found is not None and not isinstance(found, SystemExit):
        return f"{type(found).__name__}: {found}"
    if done.exit_code not in (0, 1, 2):
        return f"exit code {done.exit_code}"
    loud = [str(each.message) for each in caught if issubclass(each.category, RuntimeWarning)]
    if loud:
        return f"warns: {loud[0]}"
    if "--json" in arguments and done.exit_code < 2:
        try:
            json.loads(done.stdout, parse_constant=lambda name: pytest.fail(f"{name} in JSON"))
        except json.JSONDecodeError as error:
            return f"no JSON: {error}"
    return ""


def requested(option: str, value: str) -> list[str]:
    """The option with a value, in the unit of its kind."""
    name, _, kind = option.partition(":")
    if name == "value":
        return ["--", f"{value}{UNITS.get(kind, '')}"]
    if kind == "few" and value in ("1e9", "9" * 25):
        value = "7"
    unit = UNITS.get(kind, "")
    flag, equals, key = name.partition("=")
    return (
        [f"-{'-' * (len(flag) > 1)}{flag}", f"{key}{equals}{value}{' ' * bool(unit)}{unit}"]
        if equals
        else [f"--{name}={value}{' ' * bool(unit)}{unit}"]
    )


def command(base: tuple[str, ...], folder: Path, number: int) -> list[str]:
    file = folder / "pair.yaml"
    if not file.exists():
        file.write_text(PAIR, encoding="utf-8")
    out = folder / str(number)
    out.mkdir(exist_ok=True)
    return [part.format(pair=file, out=out) for part in base]


KEPT = [
    (base, option, value)
    for base, option, values in (
        line.split(" | ")
        for line in """
mesh 48 96 --form triangular -p clearance_factor=1.01 | p=half_angle:angle | 1e-300 1e-9
mesh 48 96 --form triangular -p clearance_factor=1.01 | module:length | 0 -1 1e300
mesh 48 96 --form triangular -p clearance_factor=1.01 --module 2mm --rate 1turn/s | inertia:inertia | 0
mesh 48 96 --form triangular -p clearance_factor=1.01 --module 2mm --inertia 1kg*m2 | rate:speed | 1e300
pin 10 | value | 1e300
pin 10 | value:length | 1e300
mesh 24 36 --compare | shaft-angle:angle | 1e-300
mesh 24 36 --form cycloidal | shaft-angle:angle | 1e-300
motion {pair} --samples 40 | turns | 1e300 nan -inf
motion {pair} --samples 40 | seed | -1
motion {pair} --samples 40 | phases | 9999999999999999999999999
draw {pair} -o {out}/d.svg | turns | inf
sphere cube | radius | inf nan
teeth ratio 5.25 | best | 9999999999999999999999999
teeth ratio 5.25 | most-total | 0
posterior {pair} --free x=47:49 | seed | -1
export planetary-24-18-60 --to {out}/e | module:length | 1e3 1e16 1e-20 0.01 0.05
export planetary-24-18-60 --to {out}/e --module 1mm | thickness:length | 1e30
export planetary-24-18-60 --to {out}/e --module 1mm | bore:length | 1e20
export planetary-24-18-60 --to {out}/e --as svg --module 1mm | sheet | 1e15x1e15mm
teeth approximants | value | 1e-320 1e-400 1e308 1e-200/1e200 1e200/1e-99
teeth ratio | value | 1e-320
teeth set --kind planetary | value | 1e-320
""".strip().splitlines()
    )
    for value in values.split()
]
"""What once ended in a traceback, in nonsense or never."""

ALL = [(" ".join(base), option, value) for base, options in CASES for option in options for value in PLAIN]


def said(text: str, option: str, value: str, folder: Path, number: int) -> str:
    """What is wrong with one command; empty if nothing is."""
    base = tuple(text.split(" "))
    told = (
        ["--json"] if base[0] in ("mesh", "motion", "posterior", "teeth", "sphere") and "--profile" not in base else []
    )
    arguments = [*command(base, folder, number), *told, *requested(option, value)]
    try:
        with chdir(folder):  # a search that is cut short leaves its journal where it runs
            found = judge(arguments)
    except TimeoutError as error:
        found = str(error)
    return found and f"{' '.join(arguments)}\n    {found}"


@pytest.mark.parametrize(("text", "option", "value"), KEPT)
def test_what_once_broke_the_command_is_answered_or_refused(text: str, option: str, value: str, tmp_path: Path) -> None:
    assert not said(text, option, value, tmp_path, 0)


FEW, MANY = 60, 120
"""Samples in every run, and with `--slow`, whose profile draws new ones (conftest.py)."""


@given(st.sampled_from(ALL), st.integers(0, 10**9))
@settings(max_examples=few_or_many(FEW, MANY), phases=(Phase.reuse, Phase.generate))
def test_any_option_of_a_number_takes_or_refuses_any_number(
    tmp_path_factory: pytest.TempPathFactory, one: tuple[str, str, str], number: int
) -> None:
    assert not said(*one, tmp_path_factory.getbasetemp(), number)


# ------------------------------------------------------------------------------------------------------- the library

ODD = st.sampled_from((0.0, -1.0, 1e-300, 1e300, nan, inf, -inf, 0.3, 1.01, 30.0))
Pins = type[PinToSlotTransmission] | type[SlotToPinTransmission]


def right_or_refused(make: Callable[[], TransmissionFunction]) -> bool:
    """True for a transmission function with finite figures, and for a refusal that says what to do."""
    try:
        made = make()
        found = [*made.speed_range(), *made.error_moments(), *made.error_range(), *made.error(np.linspace(0, 9, 7))]
    except GearTrainError as error:
        return all(problem.what and problem.fix for problem in error.problems)
    return bool(np.isfinite(found).all())


@given(ODD, ODD, ODD, st.integers(-1, 40), st.integers(-1, 40))
@settings(max_examples=150, deadline=None)
def test_sizes_and_transmissions_of_triangular_teeth_take_or_refuse_any_number(
    radius: float, beta: float, excess: float, z1: int, z2: int
) -> None:
    with warnings.catch_warnings(), bounded(SECONDS):
        warnings.simplefilter("error")
        sizes = (z1, z2, radius, radius, beta, beta, excess)
        assert right_or_refused(lambda: TriangularTransmission(TriangularSizes(*sizes), 0.1))


@given(ODD, ODD, ODD, st.sampled_from((PinToSlotTransmission, SlotToPinTransmission)))
def test_transmissions_of_pins_take_or_refuse_any_number(r: float, e: float, friction: float, kind: Pins) -> None:
    assert right_or_refused(lambda: kind(r, e, friction))


@pytest.mark.parametrize("excess", [0.04, 1.0, 1e300])
def test_the_transmission_of_wheels_apart_is_refused_in_words(excess: float) -> None:
    radii = equal_depth(48, 96, pi / 6, pi / 6)
    transmission = TriangularTransmission(TriangularSizes(48, 96, *radii, pi / 6, pi / 6, excess))
    assert transmission.verdict.kind == "apart"
    results = ("error_range", "speed_range", "error_moments", "efficiency_mean", "efficiency_at_constant_load", "kinks")
    for ask in (*(getattr(transmission, name) for name in results), lambda: transmission.jumps):
        with pytest.raises(GearTrainError, match="too far apart"):
            ask()


@pytest.mark.parametrize("turns", [1e300, nan, inf, -inf, 1e13])
def test_a_motion_over_turns_that_no_position_tells_apart_is_refused(turns: float) -> None:
    motion = geartrain.load(PAIR).motion()
    with pytest.raises(GearTrainError, match="float64 resolves single teeth only up to"):
        MotionRun(motion, turns, 10)
