"""One question has one shape of JSON, whatever the train; the schema that is shipped holds every answer."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
from answer_schemas import answer_schema, holds
from commands import HEAVY, LOCKED, RIGHT, WRONG, call
from jsonschema import Draft202012Validator, SchemaError
from sampling import all_but

from geartrain.report.json_schema import describe_answer

ANSWERS = answer_schema()["$defs"]
ONE_STATE = RIGHT.replace("inputs: {a: 1}", "states: {only: {inputs: {a: 1}}}")
TWO_STATES = RIGHT.replace("inputs: {a: 1}", "states: {only: {inputs: {a: 1}}, other: {inputs: {b: 1}}}").replace(
    "{expect: 1/2}", "{}"
)
LOADED = RIGHT + "loads: {c: -1 N m}\n"
HAND = """
name: hand
links: {frame: {}, a: {wheels: {p: {teeth: 20, module: 1 mm}}}, b: {wheels: {w: {teeth: 30, module: 1 mm}}}}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [p ~ w]
inputs: {a: 1}
outputs: {b: {}}
tooth_form: {form: triangular, half_angle: 30 deg, clearance_factor: 1.02}
thickness: 2 mm
material: ancient-bronze
loads: {b: 30 N mm}
drive: {hand: {torque: 100 N mm, range: [50 N mm, 150 N mm]}}
"""
FREE = RIGHT.replace("inputs: {a: 1}", "inputs: {}").replace("{expect: 1/2}", "{}")
LONG = RIGHT.replace("{expect: 1/2}", "{targets: [{speed: 1/2, tolerance: 1 %}]}")
KINDS = {
    "plain": RIGHT,
    "wrong": WRONG,
    "locked": LOCKED,
    "free": FREE,
    "one": ONE_STATE,
    "two": TWO_STATES,
    "loaded": LOADED,
    "target": LONG,
}


def shape(data: Any) -> Any:
    """The keys of objects, lists told by their first entry."""
    if isinstance(data, Mapping):
        return {key: shape(value) for key, value in data.items()}
    return [shape(data[0])] if isinstance(data, list) and data else type(data).__name__ if data else None


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("geartrain.analysis.accuracy._ENOUGH", 0.0)  # no shape depends on how well it is timed
    monkeypatch.setattr("geartrain.analysis.accuracy._LONG", 0.0)
    for name, off in {"measured": 0.0, "stepped": 0.3}.items():
        # even angles, and two groups of teeth apart from each other
        angles = ", ".join(f"{18 * tooth + off * (tooth > 9)} deg" for tooth in range(20))
        text = RIGHT.replace("x: 20", f"x: {{teeth: 20, cutting: {{measured: {{angles: [{angles}]}}}}}}")
        (tmp_path / f"{name}.yaml").write_text(text, encoding="utf-8")
    for name, text in {**KINDS, "heavy": HEAVY, "hand": HAND}.items():
        (tmp_path / f"{name}.yaml").write_text(text, encoding="utf-8")
    (tmp_path / "cube.txt").write_text("a b\nb c\nc d\nd a\ne f\nf g\ng h\nh e\na e\nb f\nc g\nd h\n", encoding="utf-8")
    return tmp_path


def data(*arguments: str) -> Any:
    done = call(*arguments)
    assert done.stdout, done.exception
    return json.loads(done.stdout)


@pytest.mark.parametrize("name", KINDS)
def test_the_answers_of_every_kind_of_train_hold(files: Path, name: str) -> None:
    for verb in ("solve", "torques", "report", "compare"):
        holds(verb, data(verb, f"{name}.yaml", "--json"))
    holds("solve", data("solve", f"{name}.yaml", "--method", "floats", "--json"))
    holds("solve", data("solve", f"{name}.yaml", "--of", "c", "--json"))


@pytest.mark.parametrize("verb", ["solve", "torques", "report", "compare"])
def test_no_number_of_states_changes_the_shape(files: Path, verb: str) -> None:
    found = {name: data(verb, f"{name}.yaml", "--json") for name in ("plain", "one", "two")}
    first, *others = [list(entry[0] if verb in ("report", "compare") else entry) for entry in found.values()]
    assert others == [first, first]
    entries = [entry[0] if isinstance(entry, list) else entry for entry in found.values()]
    assert [[each["state"] for each in entry["states"]] for entry in entries] == [[None], ["only"], ["only", "other"]]
    assert len({tuple(each) for entry in entries for each in entry["states"]}) == 1


@pytest.mark.parametrize("verb", ["solve", "torques"])
def test_one_state_requested_for_has_one_shape_whatever_others_there_are(files: Path, verb: str) -> None:
    one, two = (data(verb, f"{name}.yaml", "--state", "only", "--json") for name in ("one", "two"))
    assert list(one) == list(two)
    assert [each["state"] for each in one["states"]] == [each["state"] for each in two["states"]] == ["only"]
    assert shape(one["states"]) == shape(data(verb, "one.yaml", "--json")["states"])


def test_one_file_and_several_have_one_shape(files: Path) -> None:
    for verb in ("report", "compare"):
        one, both = data(verb, "plain.yaml", "--json"), data(verb, "plain.yaml", "two.yaml", "--json")
        assert (len(one), len(both)) == (1, 2)
        assert one[0] == both[0]


def test_json_is_what_a_file_of_that_name_holds(files: Path) -> None:
    for verb in ("solve", "report", "compare", "torques"):
        call(verb, "plain.yaml", "-o", f"{verb}.json")
        assert json.loads((files / f"{verb}.json").read_text(encoding="utf-8")) == data(verb, "plain.yaml", "--json")


RATIO = ("teeth", "ratio", "7/3", "--stages", "1", "--best", "2")
CUT = ("montecarlo", "moon-triangular", "--trials", "16", "--cutting", "pitch_deviation=2 %")
DOUBT = ("posterior", "target.yaml", "--free", "x=18:22", "--free", "z=38:42")
TRIANGULAR = ("mesh", "20", "30", "--form", "triangular")
IN_TIME = ("--rate", "1", "--turns", "0.1", "--skip", "0", "--steps", "200", "--no-fast")
MOTION = ("motion", "moon-triangular", "--turns", "1", "--samples", "256", "--of", "moon")
REQUESTED: dict[str, list[tuple[str, ...]]] = {
    "motion": [MOTION, (*MOTION, "--spectrum", "--phases", "2"), ("motion", "worm", "--samples", "64")],
    "dynamics": [
        ("dynamics", "heavy.yaml", *IN_TIME),
        ("dynamics", "heavy.yaml", *IN_TIME, "--restitution", "0.3"),
        ("dynamics", "worm", *IN_TIME),
    ],
    "gearbox": [("gearbox", "zf-8hp70"), ("gearbox", "simpson-set")],
    "gearbox --search": [
        ("gearbox", "zf-8hp70", "--search"),
        ("gearbox", "zf-8hp70", "--gears", "8"),
        ("gearbox", "gm-4t60", "--gears", "9"),
    ],
    "inspect formula": [
        ("inspect", "formula", "prius-power-split", "--sensitivities"),
        ("inspect", "formula", "freeth-2008"),
    ],
    "strength": [
        ("strength", "longcase-clock-loaded"),
        ("strength", "crossed-helical"),
        ("strength", "longcase-clock-loaded", "--years", "10", "--wear", "1e-6", "1e-4"),
    ],
    "budget": [
        ("budget", "moon-triangular", "--turns", "1", "--samples", "64"),
        ("budget", "freeth-2008", "--turns", "1", "--samples", "64", "--of", "moon"),
        ("budget", "moon-triangular", "--turns", "1", "--cutting", "pitch_deviation=1 %", "--trials", "4"),
    ],
    "montecarlo": [CUT, (*CUT, "--of", "moon"), (*CUT, "--vary", "window=0.2:0.8:2")],
    "feasibility": [
        ("feasibility", "moon-triangular", "--trials", "8"),
        ("feasibility", "hand.yaml", "--trials", "8", "--cutting", "pitch_deviation=6 %", "--accuracy", "0.1:1:2"),
    ],
    "posterior": [
        DOUBT,
        (*DOUBT, "--gaussian"),
        (*DOUBT, "--method", "sample", "--samples", "500"),
        (*DOUBT, "--scale", "0"),
    ],
    "inspect wheels": [("inspect", "wheels", "measured.yaml"), ("inspect", "wheels", "stepped.yaml")],
    "inspect bench": [
        ("inspect", "bench", "moon-triangular", "--samples", "50"),
        ("inspect", "bench", "lantern-mill", "--samples", "50"),
    ],
    "sphere": [
        ("sphere", "cube"),
        ("sphere", "cube", "--teeth", "4=12"),
        ("sphere", "icosidodecahedron"),
        ("sphere", "icosidodecahedron", "--teeth", "5=20,3=12"),
        ("sphere", "--graph", "cube.txt"),
    ],
    "sphere --suggest": [("sphere", "icosidodecahedron", "--suggest", "24")],
    "teeth ratio": [
        RATIO,
        (*RATIO, "--tolerance", "1e-9"),
        (*RATIO, "--range", "12:200000"),
        (*RATIO, "--range", "12:200000", "--tolerance", "1e-9"),
        ("teeth", "ratio", "3/1000", "--stages", "1", "--range", "12:200000", "--best", "1"),
        ("teeth", "ratio", "1000003", "--stages", "1", "--range", "12:20", "--tolerance", "1e-9"),
    ],
    "teeth approximants": [("teeth", "approximants", "235/19")],
    "teeth set": [("teeth", "set", "7/2", "--kind", "planetary"), ("teeth", "set", "10000", "--kind", "planetary")],
    "teeth set --kind list": [("teeth", "set", "--kind", "list")],
    "teeth train": [("teeth", "train", "pennestri-2002-missing", "--best", "1", "--workers", "1")],
    "teeth orrery": [("teeth", "orrery", "a=3", "b=5/2", "--range", "12:40")],
    "reconstruct": [
        ("reconstruct", "moon-c-e"),
        ("reconstruct", "moon-c-e", "-k", "1"),
        ("reconstruct", "metonic-l-m", "--count"),
    ],
    "optimise": [("optimise", "moon-triangular", "--of", "moon", "--objective", "jam", "--free", "window")],
    "mesh --form triangular": [
        (*TRIANGULAR, "-p", "window=0.5", "--friction", "0.2"),
        (*TRIANGULAR, "-p", "window=0.5", "--friction", "0.9"),
        (*TRIANGULAR, "-p", "clearance_factor=1.5"),
        (*TRIANGULAR, "-p", "clearance_factor=1.0001"),
        (*TRIANGULAR, "-p", "window=0.5", "--inertia", "3 g cm2"),
        (*TRIANGULAR, "-p", "window=0.5", "--inertia", "3 g cm2", "--rate", "1 turn/s", "--load", "1 N mm"),
    ],
    "mesh --form triangular --objective": [
        (*TRIANGULAR, "--objective", "loss", "--friction", "0.2", "--free", "window=0.4:0.6"),
        (*TRIANGULAR, "--objective", "jam,error", "--free", "window=0.4:0.6", "--within", "impact=0.5"),
    ],
    "mesh --form triangular --vary": [(*TRIANGULAR, "--vary", "window=0.1:0.9:3")],
    "pin": [
        ("pin", "10", "5"),
        ("pin", "10", "15"),
        ("pin", "10", "5", "--friction", "0.2", "--driver", "slot"),
    ],
    "mesh": [
        ("mesh", "24", "36", "--form", "involute", "--friction", "0.1"),
        ("mesh", "5", "6", "--form", "involute"),
        ("mesh", "8", "60", "--form", "cycloidal"),
        ("mesh", "8", "60", "--form", "lantern"),
    ],
    "mesh --compare": [("mesh", "24", "36", "--compare")],
}


@pytest.mark.parametrize("question", all_but({"inspect bench", "strength"}, REQUESTED))
def test_one_shape_for_one_question(files: Path, question: str) -> None:
    found = [data(*words, "--json") for words in REQUESTED[question]]
    for each in found:
        holds(question, each)
    if isinstance(found[0], dict) and question != "teeth set --kind list":
        assert all(list(each) == list(found[0]) for each in found), [list(each) for each in found]


def test_every_question_is_tried() -> None:
    others = {
        "solve",
        "report",
        "compare",
        "torques",
        "sphere --survey",
        "inspect graph --as json",
        "inspect graph --as matrix",
    }
    assert {*REQUESTED, *others} == set(ANSWERS)


@pytest.mark.parametrize("form", ["json", "matrix"])
def test_graphs_for_other_tools_hold(files: Path, form: str) -> None:
    holds(f"inspect graph --as {form}", data("inspect", "graph", "planetary-24-18-60", "--as", form))


def test_what_is_derived_is_as_strict_as_what_was_written_by_hand() -> None:
    """Kinds of values, choices and keys that may be left out, for one answer in full."""
    loop = {key: {"type": "array", "items": {"type": "string"}} for key in ("links", "pairs")}
    text = {"type": "string"}
    verdict = _undescribed(ANSWERS["solve"]["properties"]["states"]["items"]["properties"]["verdict"])
    assert verdict["required"] == ["kind", "text", "links", "fixes", "prescriptions", "loops"]
    assert verdict["properties"]["kind"] == {"enum": ["determined", "free", "locked", "contradictory", "refused"]}
    assert verdict["properties"]["loops"]["items"]["properties"] == {"carrier": text, **loop, "product": text}
    methods = ANSWERS["inspect bench"]["properties"]["states"]["items"]["properties"]["methods"]["items"]["properties"]
    assert methods["stage"]["enum"] == ["speeds", "motion", "torques"]
    assert methods["unit"]["enum"] == ["relative", "deg"]
    speeds = ANSWERS["solve"]["properties"]["states"]["items"]["properties"]["speeds"]
    assert speeds["additionalProperties"]["required"] == ["exact", "value"]
    floats = {"estimate", "true_error", "condition"}
    own = {"exact", "value", "decimal", "tolerance", "unit"}
    assert set(speeds["additionalProperties"]["properties"]) == own | floats
    state = ANSWERS["solve"]["properties"]["states"]["items"]
    assert "residual" in state["properties"]
    assert "residual" not in state["required"]


def _undescribed(schema: Any) -> Any:
    """A schema without its words."""
    if isinstance(schema, dict):
        return {key: _undescribed(part) for key, part in schema.items() if key != "description"}
    return [_undescribed(part) for part in schema] if isinstance(schema, list) else schema


def test_the_schema_is_one() -> None:
    Draft202012Validator.check_schema(answer_schema())
    with pytest.raises(SchemaError):  # each of $defs has been looked into
        Draft202012Validator.check_schema({"$defs": {"solve": {"type": "no type"}}})


def _without(schema: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Paths of keys that are required, as far as they lead through objects alone."""
    for key in schema.get("required", ()):
        yield (*path, key)
        yield from _without(schema["properties"][key], (*path, key))


def test_an_answer_that_lacks_a_key_or_has_a_strange_one_is_seen(files: Path) -> None:
    """The check itself can fail."""
    whole = data("solve", "plain.yaml", "--json")
    for path in _without(ANSWERS["solve"]):
        less = copy.deepcopy(whole)
        inner = less
        for step in path[:-1]:
            inner = inner[step]
        del inner[path[-1]]
        with pytest.raises(AssertionError):
            holds("solve", less)
    with pytest.raises(AssertionError):
        holds("solve", {**whole, "verdict": {}})


def test_every_key_has_a_meaning() -> None:
    silent = [
        f"{question}: {key}"
        for question in ANSWERS
        if question != "inspect graph --as json"  # keys of networkx
        for key, _, meaning in describe_answer(question).sections[0].tables[0].rows
        if not meaning and not key.endswith((".*.value", ".*.exact"))
    ]
    assert silent == []


def test_the_keys_of_a_command_are_printed() -> None:
    lines = call("inspect", "schema", "pin").output.splitlines()
    assert [line.split()[0] for line in lines if line.startswith("transmission_error")] == [
        "transmission_error",
        *(f"transmission_error.{key}" for key in ("peak_to_peak", "rms", "mean")),
    ]
    assert "did you mean 'motion'?" in str(call("inspect", "schema", "moton").exception)
