"""What cannot be read or used: always a `GearTrainError` with place, what, why and what to do, all at once."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
import yaml
from commands import call
from hypothesis import given
from hypothesis import strategies as st

from geartrain import GearTrainError, errors, load

Refuse = Callable[..., GearTrainError]

SOUND = """\
links:
  frame: {}
  a: {wheels: {p: 20}}
  b: {wheels: {w: 60}}
revolutes:
  - {pair: [frame, a], axis: A}
  - {pair: [frame, b], axis: B}
gears:
  - {pair: [p, w]}
inputs: {a: 1}
outputs:
  b: {expect: -1/3}
"""


def changed(old: str, new: str) -> str:
    assert SOUND.count(old) == 1, old
    return SOUND.replace(old, new)


def test_the_train_that_the_others_spoil_is_sound() -> None:
    assert load(SOUND).solve()


MISTAKES = {
    "unknown key": (changed("wheels: {p: 20}", "wheel: {p: 20}"), 3, ["unknown key 'wheel'", "did you mean 'wheels'?"]),
    "unknown key at the top": (changed("gears:", "gear:"), 8, ["unknown key 'gear'", "did you mean 'gears'?"]),
    "a key of another block": (changed("gears:", "module: 1 mm\ngears:"), 8, ["`module` is a key of a wheel"]),
    "a key of the train in a link": (changed("wheels: {p: 20}", "unit: rpm, wheels: {p: 20}"), 3, ["key of the train"]),
    "unknown key in a pair": (changed("{pair: [p, w]}", "{pairs: [p, w]}"), 9, ["unknown key 'pairs'", "'pair'"]),
    "duplicate key": (changed("  b: {wheels: {w: 60}}", "  a: {wheels: {w: 60}}"), 4, ["key 'a' is given twice", ":3"]),
    "duplicate key in a flow": (changed("{p: 20}", "{p: 20, p: 30}"), 3, ["key 'p' is given twice"]),
    "duplicate wheel": (changed("{w: 60}", "{w: 60, p: 9}"), 4, ["wheel 'p' is declared twice", "link 'a'"]),
    "duplicate pair": (changed("  - {pair: [p, w]}", "  - {pair: [p, w]}\n  - {pair: [p, w]}"), 10, ["declared twice"]),
    "missing wheel": (changed("[p, w]", "[p, ww]"), 9, ["no wheel 'ww'", "did you mean 'w'?"]),
    "missing link": (changed("[frame, a], axis: A", "[fram, a], axis: A"), 6, ["no link 'fram'", "'frame'"]),
    "missing frame": (changed("links:", "frame: fram\nlinks:"), 1, ["no link 'fram'", "did you mean 'frame'?"]),
    "missing input": (changed("inputs: {a: 1}", "inputs: {aa: 1}"), 10, ["no link 'aa'"]),
    "zero teeth": (changed("p: 20", "p: 0"), 3, ["'0' is not a tooth count", "from 1 to 10^12"]),
    "negative teeth": (changed("p: 20", "p: -20"), 3, ["'-20' is not a tooth count"]),
    "fractional teeth": (changed("p: 20", "p: 20.5"), 3, ["'20.5' is not a tooth count"]),
    "teeth as a fraction": (changed("p: 20", "p: 41/2"), 3, ["'41/2' is not a tooth count"]),
    "too many teeth": (changed("p: 20", "p: 1000000000001"), 3, ["'1000000000001' is not a tooth count"]),
    "a tooth count of many digits": (changed("p: 20", "p: 1" + "0" * 5000), 3, ["is not a tooth count"]),
    "a pair on one link": (changed("[p, w]", "[p, p2]").replace("{p: 20}", "{p: 20, p2: 9}"), 9, ["same link", "'a'"]),
    "two rings": (
        changed("p: 20", "p: {teeth: 20, internal: true}").replace("w: 60", "w: {teeth: 60, internal: true}"),
        9,
        ["two rings"],
    ),
    "coaxial links in a pair": (changed("axis: B", "axis: A"), 9, ["no carrier", "coaxial", "a -(A)- frame -(A)- b"]),
    "two changes of label": (
        changed("  b: {wheels", "  c: {}\n  b: {wheels").replace(
            "- {pair: [frame, b], axis: B}", "- {pair: [frame, c], axis: C}\n  - {pair: [c, b], axis: B}"
        ),
        11,
        ["no carrier", "frame", "c", "centre distance is not fixed"],
    ),
    "a cycle of turning pairs": (changed("gears:", "  - {pair: [a, b], axis: A}\ngears:"), 8, ["cycle"]),
    "a turning pair twice": (changed("gears:", "  - {pair: [frame, b], axis: B}\ngears:"), 8, ["cycle"]),
    "a turning pair with itself": (changed("[frame, b]", "[b, b]"), 7, ["connects 'b' to itself"]),
    "one label for two axes": (
        changed("  b: {wheels", "  c: {}\n  b: {wheels").replace(
            "- {pair: [frame, b], axis: B}", "- {pair: [a, c], axis: C}\n  - {pair: [c, b], axis: A}"
        ),
        9,
        ["axis label 'A' names two axes", ":7"],
    ),
    "a missing key": (changed(", axis: B", ""), 7, ["key 'axis' is missing"]),
    "a pair of three": (changed("[p, w]", "[p, w, p]"), 9, ["pair"]),
    "a mapping for a list": (changed("  - {pair: [p, w]}", "  {pair: [p, w]}"), 8, ["gears"]),
    "yes for true": (changed("w: 60", "w: {teeth: 60, internal: yes}"), 4, ["'yes' is neither true nor false"]),
    "no number": (changed("expect: -1/3", "expect: 1/3/5"), 12, ["'1/3/5' is not a number"]),
    "infinity": (changed("inputs: {a: 1}", "inputs: {a: .inf}"), 10, ["not a number"]),
    "not a number": (changed("inputs: {a: 1}", "inputs: {a: nan}"), 10, ["not a number"]),
    "a number of very many digits": (changed("{a: 1}", "{a: " + "7" * 5000 + "}"), 10, ["not a number"]),
    "an exponent out of all bounds": (changed("{a: 1}", "{a: 1e999999999}"), 10, ["1e999999999"]),
    "null as a key": (changed("  frame: {}", "  frame: {}\n  ~: {}"), 3, ["null is used as a key"]),
    "a list as a key": (changed("  frame: {}", "  frame: {}\n  [a]: {}"), 3, ["used as a key"]),
    "a tag": (changed("p: 20", "p: !!python/name:os.system 20"), 3, ["tag", "remove the tag"]),
    "a tag of one's own": (changed("p: 20", "p: !teeth 20"), 3, ["tag '!teeth'"]),
    "a second document": (SOUND + "---\nlinks: {}\n", 13, ["a second document"]),
    "a missing anchor": (changed("p: 20", "p: *twenty"), 3, ["twenty"]),
    "an anchor twice": (changed("p: 20", "p: &t 20").replace("w: 60", "w: &t 60"), 4, ["'&t' is given twice"]),
    "an alias within itself": (changed("  frame: {}", "  frame: &f {wheels: *f}"), 2, ["contains itself"]),
    "broken brackets": (changed("{pair: [p, w]}", "{pair: [p, w}"), 9, ["invalid YAML syntax"]),
}  # fmt: skip


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_said_with_its_line(refused: Refuse, mistake: str) -> None:
    text, line, said = MISTAKES[mistake]
    error = refused(text, *said, line=line)
    assert all(problem.why or problem.fix for problem in error.problems)
    assert len(str(error)) < 2000, "a message is read by a person"


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (("p: 20", "w: 60", "axis: B"), ("p: 0", "w: 2.5", "axes: B"), [":3: ", ":4: ", ":7: "]),
        (
            ("[p, w]", "{a: 1}", "b: {expect"),
            ("[x, y]", "{z: 1}", "q: {expect"),
            ["no wheel 'x'", "no wheel 'y'", "no link 'z'", "no link 'q'"],
        ),
        (
            ("axis: B", "[p, w]}"),
            ("axis: A", "[p, w]}\n  - {id: again, pair: [w, p]}"),
            ["'p~w' has no carrier", "'again' has no carrier"],
        ),
    ],
)
def test_several_mistakes_are_reported_together(refused: Refuse, old: Any, new: Any, said: list[str]) -> None:
    text = SOUND
    for one, other in zip(old, new, strict=True):
        text = text.replace(one, other)
    assert len(refused(text, *said).problems) >= len(said)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        *((each, "empty") for each in (b"", b"   \n\n", b"# only a remark\n", b"---\n", b"~\n", b"null\n")),
        *((each, "not a mapping") for each in (b"- a\n- b\n", b"just words\n", b"42\n")),
        *((each, "text|YAML") for each in (b"\x89PNG\r\n\x1a\n\x00\x00", b"links: {a: \xff\xfe}", bytes(range(256)))),
        *((each, "text|YAML") for each in (b"links:\x00\n", b"\x1b[31mlinks: {}\n")),
    ],
)
def test_a_file_without_a_declaration_is_refused(tmp_path: Path, content: bytes, said: str) -> None:
    path = tmp_path / "nothing.yaml"
    path.write_bytes(content)
    with pytest.raises(GearTrainError, match=said) as caught:
        load(path)
    assert str(path) in str(caught.value)


def test_what_is_no_regular_file_is_refused(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.yaml"
    os.mkfifo(pipe)
    for path, said in (
        *((each, "this is not a regular file") for each in (pipe, Path("/dev/zero"), Path("/dev/null"))),
        (tmp_path, "this is a directory"),
        (tmp_path / "absent.yaml", "the file does not exist"),
        ("pennestri-2022", "pennestri-2002"),
    ):
        with pytest.raises(GearTrainError, match=said):
            load(path)


def test_a_byte_order_mark_and_dos_line_ends_do_no_harm(tmp_path: Path) -> None:
    path = tmp_path / "dos.yaml"
    path.write_bytes(b"\xef\xbb\xbf" + SOUND.replace("\n", "\r\n").encode())
    assert load(path).solve()


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root reads everything")
def test_a_file_that_may_not_be_read_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "secret.yaml"
    path.write_text(SOUND, encoding="utf-8")
    path.chmod(0)
    with pytest.raises(GearTrainError, match="cannot be read"):
        load(path)


def test_an_alias_bomb_is_refused_before_it_goes_off(refused: Refuse) -> None:
    lines = ["a0: &a0 [lol, lol, lol, lol, lol, lol, lol, lol, lol, lol]"]
    lines += [f"a{at}: &a{at} [{', '.join([f'*a{at - 1}'] * 10)}]" for at in range(1, 12)]
    refused("\n".join(lines) + "\n", "aliases expand to too many values")


MANY = 3000
WRONG = {
    "entries that are no mappings": "links: {frame: {}}\ngears: [" + "1," * MANY + "]",
    "no tooth counts": "links: {frame: {wheels: {" + "".join(f"w{at}: x," for at in range(MANY)) + "}}}",
    "unknown keys": "links: {frame: {}}\n" + "".join(f"k{at}: 1\n" for at in range(MANY)),
    "keys twice": "links: {frame: {}}\nsources: {" + "a: b," * MANY + "}",
    "dangling names": "links: {frame: {}}\nfixed: [" + ",".join(f"x{at}" for at in range(MANY)) + "]",
    "weights": "links: {frame: {wheels: {a: {teeth: {value: 5, choices: [5, 6], weights: [" + "x," * MANY + "]}}}}}",
    "wrong at the end": "links: {frame: {}}\ngears: [" + "{pair: [a, b]}," * 500 + "1," * MANY + "]",
    "wrong pairs": "links: {frame: {}}\nrevolutes: [" + "{pair: [a]}," * MANY + "]",
}


@pytest.mark.parametrize("kind", WRONG)
def test_a_file_that_is_wrong_many_times_is_told_at_most_twenty_and_that_there_is_more(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = []

    class Counted(errors.Problem):
        def __init__(self, *args: str) -> None:
            super().__init__(*args)
            made.append(self)

    for module in ("validation", "yaml_nodes", "references"):
        monkeypatch.setattr(f"geartrain.train.{module}.Problem", Counted)
    with pytest.raises(GearTrainError) as caught:
        load(WRONG[kind] + "\n")
    problems = caught.value.problems
    assert 1 <= len(problems) <= 21
    assert len(problems) == 1 or re.search("and .*more problems were found", str(problems[-1]))
    assert kind != "entries that are no mappings" or f"and {MANY - 20} more" in str(problems[-1])
    assert len(made) < 60  # and no more were put into words


def test_a_file_of_more_values_than_a_train_has_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("geartrain.train.yaml_nodes.MOST_VALUES", 1000)
    with pytest.raises(GearTrainError, match="the file is too large"):
        load("links: {frame: {}}\nfixed: [" + "a," * 1000 + "]\n")


def test_aliases_in_reason_are_welcome() -> None:
    text = SOUND.replace("p: 20", "p: &t 20").replace("w: 60", "w: *t").replace("-1/3", "-1")
    assert load(text).solve()


@pytest.mark.parametrize(("opening", "closing"), [("[", "]"), ("{a: ", "}")])
def test_deep_nesting_is_refused(refused: Refuse, opening: str, closing: str) -> None:
    refused(f"links: {opening * 20000}{closing * 20000}\n", "nested too deeply", line=1)


@given(st.text(alphabet="{}[]:,-&*!|>'\"%@`#? \n\tabp0159~/.", max_size=60))
def test_no_text_whatever_raises_anything_but_our_own_error(text: str) -> None:
    with suppress(GearTrainError):
        load(text + "\n")


@given(st.data())
def test_no_scrambled_declaration_raises_anything_but_our_own_error(draw: st.DataObject) -> None:
    lines = SOUND.splitlines()
    at = draw.draw(st.integers(0, len(lines) - 1))
    words = ["{}", "[]", "~", "0", "-1", "frame", "a", "[a]", "{a: 1}", "1e9", "yes", "''", "1:30", "[[a, b]]"]
    old = draw.draw(st.sampled_from(["{p: 20}", "{}", "[frame, a]", "A", "[p, w]", "{a: 1}", "{expect: -1/3}", "60"]))
    text = "\n".join(line if number != at else f"{line} " for number, line in enumerate(lines))
    text = text.replace(old, draw.draw(st.sampled_from(words)), 1)
    try:
        train = load(text + "\n")
    except GearTrainError as error:
        problems = error.problems
    else:
        problems = ()
        for answer in train.answers():
            answer.to_dict()
        assert train.mobility.by_rank >= 0
    assert all(problem.what and problem.fix for problem in problems)


# data that came from no file: the place is the path of the value
JOINED = {"links": {"frame": {}, "a": {}}, "revolutes": [{"pair": ["frame", "a"], "axis": "A"}]}
TEETH = (20.0, 20.5, True, None, [], "20 teeth", 10**13, float("nan"), b"20")


@pytest.mark.parametrize(
    ("data", "place"),
    [
        ({"links": {"frame": {}, "a": {"wheels": {"p": 0}}}}, "links.a.wheels.p"),
        *(({"links": {"frame": {}, "a": {"wheels": {"p": teeth}}}}, "links.a.wheels.p") for teeth in TEETH),
        *((JOINED | {"inputs": {"a": speed}}, "inputs.a") for speed in (float("nan"), float("inf"), True, None)),
        *((JOINED | {"inputs": {"a": speed}}, "inputs.a") for speed in ([1], b"1", 1j)),
        *((each, "") for each in ({}, {"links": None}, {"links": {}}, {"links": []}, {1: 2})),
    ],
)
def test_a_mistake_in_plain_data_is_reported_with_its_path(data: Any, place: str) -> None:
    with pytest.raises(GearTrainError) as caught:
        load(data)
    assert caught.value.problems[0].place.startswith(place)


@pytest.mark.parametrize(
    ("old", "new", "what", "fix"),
    [
        ("  - {pair: [p, w]}\n", "  - [p, w]\n" * 40, "40 entries of `gears` are lists", "write `p ~ w`"),
        (
            "{pair: [frame, a], axis: A}\n  - {pair: [frame, b], axis: B}",
            "[frame, a]\n  - [frame, b]",
            "2 entries of `revolutes` are lists",
            "`{pair: [frame, a], axis: A}`",
        ),
    ],
)
def test_pairs_that_are_lists_are_answered_once(refused: Refuse, old: str, new: str, what: str, fix: str) -> None:
    (problem,) = refused(changed(old, new)).problems
    assert problem.what == what
    assert fix in problem.fix
    with pytest.raises(GearTrainError, match=what):
        load(yaml.safe_load(changed(old, new)))


def test_a_missing_revolutes_is_one_error(refused: Refuse) -> None:
    links = "".join(f"  l{at}: {{wheels: {{w{at}: {20 + at}}}}}\n" for at in range(13))
    gears = ", ".join(f"w{at} ~ w{at + 1}" for at in range(12))
    (problem,) = refused(f"links:\n  frame: {{}}\n{links}gears: [{gears}]\ninputs: {{l0: 1}}\n").problems
    assert problem.what == "no turning pair is declared"
    assert "`revolutes: {A: [frame, l0]}`" in problem.fix


def refusal(text: str) -> str:
    """The message of a refused text; nothing of one that is accepted."""
    try:
        load(text)
    except GearTrainError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("kind", ["pin_and_slot", "pin_follower", "pins_in_holes", "parallel"])
def test_a_key_of_another_coupling_is_never_suggested_for_itself(kind: str) -> None:
    for key in ("pin_radius", "offset", "pins", "pin_diameter", "clearance", "pin_mass"):
        text = f"{SOUND}couplings: [{{kind: {kind}, pin: a, slot: b, {key}: 1 mm}}]\n"
        if message := refusal(text):
            assert f"did you mean '{key}'" not in message


def test_a_link_borne_by_several_is_refused_with_both_ways_to_declare_it(refused: Refuse) -> None:
    error = refused(
        "links: {frame: {}, in: {wheels: {s: 20}}, crank: {wheels: {g: 40}, copies: 3}, disc: {}, out: {}}\n"
        "revolutes: {A: [frame, in, out], C: [out, crank], D: [crank, disc]}\ngears: [s ~ g]\ninputs: {in: 1}\n"
    )
    (problem,) = error.problems
    assert "`copies: 3`" in problem.fix
    assert "`{kind: parallel, pin: crank, slot: added}`" in problem.fix
    assert load("rv-reducer").solve()  # the train that the fix names


def test_a_long_locked_loop_is_abbreviated(tmp_path: Path) -> None:
    count = 2017
    links = ", ".join(f"a{at}: {{wheels: {{w{at}: {20 + at % 7}}}}}" for at in range(count))
    axes = ", ".join(f"X{at}: [frame, a{at}]" for at in range(count))
    gears = ", ".join(f"w{at} ~ w{(at + 1) % count}" for at in range(count))
    path = tmp_path / "long.yaml"
    text = f"links: {{frame: {{}}, {links}}}\nrevolutes: {{{axes}}}\ngears: [{gears}]\ninputs: {{a0: 1}}\n"
    path.write_text(text, encoding="utf-8")
    verdict = load(path).solve().verdict
    assert verdict.kind == "locked"
    assert len(verdict.loops[0].links) == count
    assert "and 2005 more" in verdict.text
    assert max(map(len, call("check", path).output.splitlines())) < 1000
