"""What Python shows of a result: a line as its `repr`, the text of its command as its `str`, tables in a notebook."""

from __future__ import annotations

import dataclasses
import inspect
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cache
from html import escape
from importlib import import_module
from typing import Any
from xml.etree import ElementTree

import pytest
from commands import LOCKED, call
from dynamics.test_uncounted_losses import PIN
from package.test_public_names import SHOWING

import geartrain
from geartrain import GearTrain

load = cache(geartrain.load)
SLIDER = PIN.replace("friction: 0.3", "friction: {sliding: 0.3, deviation: 0.05}")
SMALL_RING = """
links: {frame: {wheels: {ring: {teeth: 16, internal: true}}}, arm: {}, planet: {wheels: {p: 20}}}
revolutes: {main: [frame, arm], planet: [arm, planet]}
gears: [ring ~ p]
inputs: {arm: 1}
"""


def room(name: str) -> Any:
    return import_module(f"geartrain.{name}")


def icosidodecahedron() -> Any:
    return room("spherical").from_polyhedron("icosidodecahedron", teeth={"5": 20, "3": 12})


def ranges() -> Any:
    return room("search").read_counts("15:60")


def ratio(text: str) -> Any:
    return room("search").read_ratio(text)


def fractions() -> Any:
    found = room("search").approximants(Fraction(254, 19), 100)
    return room("search.stern_brocot").Approximants(ratio("254/19"), 100, found)


def sizes() -> Any:
    own = room("workshop").ToothSizes((48, 96), 1.0, 0.5, (0.5235987755982988,) * 2, 0.2)
    return room("workshop").find_tooth_sizes(own, ("loss",), {"radii": None})


def evidence() -> Any:
    return room("search.reconstruct").read_evidence("metonic-l-m")


def in_time() -> Any:
    return load("moon-triangular-inertia").dynamics("1 turn/s", turns=0.02, skip=0, steps=2000)


def trial_plan() -> Any:
    errors = room("workshop").read_error_overrides(["pitch_deviation=2 %"])
    return room("workshop").find_trial_plan(load("moon-triangular"), errors)


def trials() -> Any:
    return room("workshop").run_trials(trial_plan(), 4)


def friction_trials() -> Any:
    plan = room("workshop").FrictionPlan(load(SLIDER).declaration, 1.0, 40)
    return room("workshop").try_frictions(plan, 12)


def budget() -> Any:
    asked = room("workshop").BudgetQuestion(outputs=("moon",), turns=1.0, samples=64)
    return room("workshop").find_budget(load("moon-triangular"), asked)


def pin() -> Any:
    return room("teeth").PinToSlotTransmission(10, 5)


def reports(name: str) -> Any:
    train = load("longcase-clock-loaded")
    if name == "torques":
        return room("report.torque_report").collect_torque_report(train, [train.torques()])
    if name == "strength":
        return room("simulation.strength.strength_report").collect_strength_report(train, [train.strength()])
    if name == "motion":
        run = load("moon-triangular").motion().run(1.0, 64)
        return room("report.motion_report").collect_motion(run, "moon-triangular", None)
    return room("report.formula_report").collect_formulas(load("planetary-24-18-60"), [None])


MOTION = ("motion", "moon-triangular")
IN_TIME = ("--rate", "1 turn/s", "--turns", "0.02", "--skip", "0", "--steps", "2000")

Case = tuple[Callable[[], Any], tuple[str, ...] | None]

RESULTS: dict[str, Case] = {
    # core: train, kinematics
    "train": (lambda: load("planetary-24-18-60"), None),
    "answer": (lambda: load("planetary-24-18-60").solve(), ("solve", "planetary-24-18-60")),
    "answer of a state": (lambda: load("simpson-set").solve("1"), ("solve", "simpson-set", "--state", "1")),
    "answer of an output": (
        lambda: load("freeth-2021").solve(output="moon"),
        ("solve", "freeth-2021", "--of", "moon"),
    ),
    "answer in floats": (
        lambda: load("worm").solve(method="sparse"),
        ("solve", "worm", "--method", "sparse"),
    ),
    "equations": (lambda: load("worm").equations(), ("inspect", "equations", "worm")),
    "matrix": (lambda: load("worm").equations().matrix(), None),
    "formula": (lambda: load("worm").formula(next(iter(load("worm").declaration.outputs))), None),
    "formulas": (lambda: reports("inspect formula"), ("inspect", "formula", "planetary-24-18-60")),
    "variants": (lambda: load("freeth-2021").variants({"b1": range(220, 228)}, ["mars"]), None),
    "mobility": (lambda: load("four-gear-loop").mobility, None),
    "gridlock": (lambda: load("four-gear-loop").kinematics.gridlock, None),
    "closure": (lambda: load("planets-in-place").closure, None),
    "graph": (lambda: load("planetary-24-18-60").graph, None),
    "floats": (lambda: load("planetary-24-18-60").kinematics.floats(), None),
    "kinematics": (lambda: load("planetary-24-18-60").kinematics, None),
    "mechanics": (lambda: load("planetary-24-18-60").mechanics, None),
    "declaration": (lambda: load("planetary-24-18-60").declaration, None),
    "levers": (lambda: lever(load("planetary-24-18-60")), None),
    "build findings": (lambda: load(SMALL_RING).build_findings[0], None),
    "gearbox": (lambda: load("zf-8hp70").gearbox(), ("gearbox", "zf-8hp70")),
    "gear search": (lambda: room("analysis").find_gears(load("zf-8hp70")), ("gearbox", "zf-8hp70", "--search")),
    "accuracy": (lambda: room("analysis.accuracy").find_accuracy(load("planetary-24-18-60"), None, 100), None),
    # core: torques, motion
    "torques": (lambda: load("longcase-clock-loaded").torques(), ("torques", "longcase-clock-loaded")),
    "driven": (lambda: load("planetary-24-18-60").driven("carrier", "sun"), None),
    "torque cycle": (
        lambda: load("longcase-clock-loaded").torques(turns=0.1, samples=40),
        ("torques", "longcase-clock-loaded", "--turns", "0.1", "--samples", "40"),
    ),
    "torque report": (lambda: reports("torques"), ("torques", "longcase-clock-loaded")),
    "power flow": (lambda: room("dynamics").find_power_flow(load("longcase-clock-loaded").torques()), None),
    "motion": (lambda: load("moon-triangular").motion(), MOTION),
    "run of a motion": (
        lambda: load("moon-triangular").motion().run(1.0, 64),
        (*MOTION, "--turns", "1", "--samples", "64"),
    ),
    "motion figures": (lambda: reports("motion"), (*MOTION, "--turns", "1", "--samples", "64")),
    "transmission error": (lambda: load("moon-triangular").motion().transmission_error("moon"), None),
    "errors at positions": (lambda: load("moon-triangular").motion().at([0.0, 0.1]), None),
    "corners": (lambda: load("moon-triangular").motion().kink_positions(0, 1), None),
    # core: teeth
    "mesh": (lambda: load(PAIR).meshes[0], ("mesh", "24", "36", "--form", "involute")),
    "transmission function": (lambda: load("sorge-pairs").meshes[0].transmission, None),
    "pin": (pin, ("pin", "10", "5")),
    "comparison of forms": (
        lambda: room("teeth").compare_forms(room("teeth.conjugate").WheelPair(24, 36), ["cycloidal"]),
        ("mesh", "24", "36", "--compare", "--form", "cycloidal"),
    ),
    # core: spheres, scenes, report
    "polyhedron": (lambda: room("spherical").solid("cube"), None),
    "configuration": (icosidodecahedron, None),
    "sphere": (
        lambda: room("spherical").GearSphere(icosidodecahedron()),
        ("sphere", "icosidodecahedron", "--teeth", "5=20,3=12"),
    ),
    "sizes on a sphere": (lambda: room("spherical").size_gears(icosidodecahedron()), None),
    "gears of a graph": (lambda: room("spherical").from_graph([("a", "b"), ("b", "c"), ("c", "d"), ("d", "a")]), None),
    "suggested counts": (
        lambda: room("spherical").suggest_tooth_counts(room("spherical").from_polyhedron("icosidodecahedron"), 20, 5),
        ("sphere", "icosidodecahedron", "--suggest", "20", "--best", "5"),
    ),
    "survey": (lambda: room("spherical").survey(("cube",))[0], None),
    "layout": (lambda: room("scene").lay_out(load("planetary-24-18-60")), None),
    "scene": (lambda: room("scene").build_scene(load("planetary-24-18-60")), None),
    "report": (lambda: room("report").collect_report(load("worm")), ("report", "worm")),
    "document": (lambda: load("worm").report(), None),
    # wing: search
    "wanted ratio": (lambda: ratio("235/19"), None),
    "stages": (
        lambda: room("search").find_stages(ratio("235/19"), 2, ranges(), ranges()),
        ("teeth", "ratio", "235/19", "--range", "15:60"),
    ),
    "fractions": (fractions, ("teeth", "approximants", "254/19", "--range", "12:100")),
    "sets": (
        lambda: room("search").find_sets(ratio("7/2"), "planetary", "all", ranges(), spaced=False),
        ("teeth", "set", "7/2", "--kind", "planetary", "--range", "15:60"),
    ),
    "orrery": (
        lambda: room("search").find_orrery({"moon": Fraction(19, 254)}, ranges(), Fraction(1, 1000)),
        ("teeth", "orrery", "moon=19/254", "--range", "15:60", "--tolerance", "0.001"),
    ),
    "counts of a train": (
        lambda: room("search").search_train(declaration("pennestri-2002-missing")),
        ("teeth", "train", "pennestri-2002-missing"),
    ),
    "posterior": (
        lambda: room("search").infer_counts(load("freeth-2008-doubt").declaration),
        ("posterior", "freeth-2008-doubt"),
    ),
    "reconstruction": (
        lambda: room("search.reconstruct").reconstruct(room("search.reconstruct").ReconstructionRequest(evidence())),
        ("reconstruct", "metonic-l-m"),
    ),
    "reconstructions": (
        lambda: room("search.reconstruct").find_reconstructions(
            room("search.reconstruct").evidence_question(evidence()).problem
        ),
        None,
    ),
    # wing: workshop
    "trial plan": (trial_plan, None),
    "trials": (
        trials,
        ("montecarlo", "moon-triangular", "--trials", "4", "--cutting", "pitch_deviation=2 %"),
    ),
    "friction trials": (friction_trials, None),
    "feasibility": (
        lambda: room("workshop").run_feasibility(room("workshop").find_feasibility_plan(load("moon-triangular")), 4),
        ("feasibility", "moon-triangular", "--trials", "4"),
    ),
    "budget": (
        budget,
        ("budget", "moon-triangular", "--turns", "1", "--samples", "64", "--of", "moon"),
    ),
    "sizes of a train": (
        lambda: room("workshop").find_train_sizes(load("moon-triangular"), "moon", "jam", {"window": None}),
        ("optimise", "moon-triangular", "--of", "moon", "--objective", "jam", "--free", "window"),
    ),
    "sizes of a pair": (
        sizes,
        ("mesh", "48", "96", "--form", "triangular", "--friction", "0.2", "--objective", "loss"),
    ),
    "parts": (lambda: room("workshop.export.parts_list").parts_list(solid_model())[0], None),
    "files": (lambda: room("workshop").export_files(solid_model(), ["graphml"])[0], None),
    # wing: simulation
    "strength": (lambda: load("longcase-clock-loaded").strength(), ("strength", "longcase-clock-loaded")),
    "run in time": (in_time, ("dynamics", "moon-triangular-inertia", *IN_TIME)),
    "simulation": (lambda: load("moon-triangular-inertia").simulation("1 turn/s", step=1e-3), None),
    "rates of separation": (
        lambda: room("simulation").find_separation(load("moon-triangular-inertia").mechanics, turns=1),
        None,
    ),
    "inertias": (lambda: room("simulation").find_link_inertias(load("moon-triangular-inertia").mechanics)[0], None),
}
PAIR = """
links: {frame: {}, a: {wheels: {p: 24}}, b: {wheels: {w: 36}}}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [p ~ w]
tooth_form: involute
inputs: {a: 1}
"""


def declaration(name: str) -> Any:
    return room("train.declaration_files").read_declaration(name)


def solid_model() -> Any:
    scene = room("scene")
    return scene.SolidModel(load("planetary-24-18-60"), scene.ManufacturingSizes(module=2.0))


def lever(train: GearTrain) -> Any:
    return room("kinematics.levers").find_levers(train.declaration, train.kinematics.tree, train.circuits)[0]


made = cache(lambda name: RESULTS[name][0]())
TOLD = [name for name, (_, command) in RESULTS.items() if command is not None]


def lines(text: str) -> list[str]:
    return [line.rstrip() for line in text.rstrip().splitlines()]


@pytest.mark.parametrize("name", RESULTS)
def test_the_line_of_a_result_is_one_short_line_without_an_address(name: str) -> None:
    for each in parts(made(name)):
        line = repr(each)
        assert "\n" not in line, type(each)
        assert " at 0x" not in line, type(each)
        assert len(line) < 200, type(each)


@pytest.mark.parametrize("name", TOLD)
def test_a_result_prints_what_its_command_prints(name: str) -> None:
    done = call(*(RESULTS[name][1] or ()))
    assert done.exit_code in (0, 1), done.output
    assert lines(str(made(name))) == lines(done.stdout)


@pytest.mark.needs("jinja2")
@pytest.mark.parametrize("name", RESULTS)
def test_a_notebook_shows_well_formed_html(name: str) -> None:
    result = made(name)
    write = getattr(result, "_repr_html_", None)
    if write is None:
        assert any(hasattr(result, f"_repr_{kind}_") for kind in ("markdown", "latex")) or not hasattr(result, "PAGE")
        return
    page = write()
    assert ElementTree.fromstring(f"<div>{closed(page)}</div>").text is None or "<" in page
    if getattr(type(result), "PAGE", ""):
        assert "<table" in page or not hasattr(result, "to_frame")


@pytest.mark.needs("matplotlib", "jinja2")
@pytest.mark.parametrize("name", ["freeth-2021", "zf-8hp70", "planetary", "screw-jack"])
def test_a_train_in_a_notebook_is_small_and_has_a_picture_a_verdict_and_outputs(name: str) -> None:
    train = load(name)
    page = train._repr_html_()
    assert len(page.encode()) < 60_000
    assert page.index("Verdict: determined") < page.index("<table") < page.index('src="data:image/png;base64,iVBOR')
    assert "Speeds are" in page
    shown = train.solve(train.declaration.state_or_first(None)).outputs
    assert sum(escape(output) in page for output in shown) >= 1


def test_a_train_in_a_notebook_has_its_names_escaped() -> None:
    train = geartrain.load(f"title: <script>alert(1)</script>\n{LOCKED}")
    page = train._repr_html_()
    assert "&lt;script&gt;" in page
    assert "<script" not in page


def closed(page: str) -> str:
    """HTML with no element that XML would take for open."""
    assert not re.search(r"<(br|img|hr|input)\b[^>]*[^/]>", page)
    return page


@cache
def public_classes() -> frozenset[type]:
    rooms = (import_module(f"geartrain.{name}") for name in SHOWING if name != "errors")
    members = (getattr(each, name) for each in rooms for name in each.__all__)
    return frozenset(each for each in members if isinstance(each, type))


def parts(result: Any, depth: int = 3) -> Iterator[Any]:
    """A result and what stands in its fields: objects of public classes, some of each container."""
    if type(result) in public_classes() or not depth - 3:
        yield result
    if depth and dataclasses.is_dataclass(result):
        for field in dataclasses.fields(result):
            if not field.name.startswith("_"):
                yield from parts(getattr(result, field.name), depth - 1)
    elif depth and isinstance(result, Mapping | Sequence) and not isinstance(result, str | bytes | range):
        values = result.values() if isinstance(result, Mapping) else result
        for value in list(values)[:4]:
            yield from parts(value, depth - 1)


def returned(function: Any) -> set[type]:
    """Public classes that a function is annotated to return, by itself or in a container."""
    try:
        found = get_type_hints(function).get("return")
    except NameError:  # a name for types only
        return set()
    todo, kinds = [found], set()
    while todo:
        each = todo.pop()
        todo += getattr(each, "__args__", ())
        if isinstance(each, type):
            kinds.add(each)
    return kinds & public_classes()


INPUTS = {
    *("TargetRatio", "CountRuns", "CalendarDate", "EvidenceQuestion", "CutSides", "Train", "GearTrain"),
    *("Document", "FlankContact", "TwoFlankContact", "ClearanceWindow", "GearOutline", "OutlineCurve"),
}
"""What functions return that is a question, a declaration or a curve, and no result of a train."""


def test_every_result_of_a_public_function_is_tried_here() -> None:
    tried = {type(each) for name in RESULTS for each in parts(made(name), 4)}
    missing = set()
    for name in SHOWING:
        module = import_module(f"geartrain.{name}")
        for member in module.__all__:
            function = getattr(module, member)
            if inspect.isfunction(function):
                missing |= {each.__name__ for each in returned(function) if each not in tried}
    assert missing <= INPUTS, missing - INPUTS
