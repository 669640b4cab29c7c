"""Mistakes of a first declaration: each message in full, with place, reason and a correction to paste."""

from __future__ import annotations

from pathlib import Path

import pytest
from commands import ended

pytestmark = pytest.mark.usefixtures("here")

SOUND = """\
links:
  frame: {}
  a: {wheels: {p: 20}}
  b: {wheels: {w: 60}}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [p ~ w]
inputs: {a: 1}
outputs: {b: {expect: -1/3}}
"""

MISTAKES = r"""
# a unit that is misspelt: |links:|unit: {per: 12 hrs}\nlinks:|
error: my.yaml:1: '12 hrs' is not a unit
  why: `per` is a time, a length, or a period listed by `geartrain periods`
  fix: for example, write `unit: {per: 12 h}`; units: s, min, h, d, m, cm, mm, um, in, ft, km, mile

# a unit without `per`: |links:|unit: 12 h\nlinks:|
error: my.yaml:1: `unit` is not a mapping of keys to values
  why: the given value is '12 h'
  fix: for example, write `unit: {per: 12 h}`

# a speed as the unit: |links:|unit: {per: rpm}\nlinks:|
error: my.yaml:1: 'rpm' is not a unit
  why: `per` is a time, a length, or a period listed by `geartrain periods`
  fix: omit `unit`, and write inputs with their unit: `inputs: {a: 30 rpm}`

# no unit: |expect: -1/3|targets: [{period: 3 d}]|
error: my.yaml:8: a period cannot be a target of this train
  why: the train has no unit of time
  fix: for example, add `unit: {per: 1 d}`: a speed of 1 is then one turn per day

# a length without unit: |{p: 20}|{p: {teeth: 20, thickness: 3}}|
error: my.yaml:3: `links.a.wheels.p.thickness`: '3' has no unit
  fix: for example, write '3 mm'; units: m, cm, mm, um, in, ft, km, mile

# the unit of an input: |{a: 1}|{a: 30 1/min}|
error: my.yaml:7: `inputs.a`: '30 1/min' has an unknown unit
  fix: for example, write '30 rpm'; units: rpm, turn/s, turn/min, turn/h, turn/d, deg/s, rad/s, m, cm, mm, um, in, ft, km, mile, m/s, mm/s, mm/min, ft/min, in/s

# an unknown parent: |links:|extends: planetery\nlinks:|
error: my.yaml:1: `extends` names the unknown parent 'planetery'
  why: the current folder contains no such file, and no shipped train or evidence has that name
  fix: did you mean 'planetary' or 'norton-planetary' or 'planetary-24-18-60'?

# no turning pairs: |revolutes: {A: [frame, a], B: [frame, b]}\n||
error: my.yaml:1: no turning pair is declared
  why: every link but 'frame' turns on an axis that another link carries
  fix: for example, add `revolutes: {A: [frame, a]}`, with an entry for each axis

# no fixed link: |  frame: {}\n||
error: my.yaml:1: no link 'frame'
  why: it is the fixed link, unless the key `frame` names another one
  fix: add `frame: {}` to `links`, or name the fixed link: `frame: a`

# an unknown clutch: |inputs: {a: 1}|clutches: {C1: {fixes: a}}\nstates: {low: {engaged: [C2]}}|
error: my.yaml:8: no clutch 'C2'
  why: `states.low.engaged[0]` refers to it
  fix: use one of: C1; or declare `clutches: {C2: {fixes: a}}`

# a pair as a list: |[p ~ w]|[[p, w]]|
error: my.yaml:6: an entry of `gears` is a list
  why: each entry has the form `a ~ b`
  fix: write `p ~ w`

# pairs as a list of wheels: |[p ~ w]|[p, w]|
error: my.yaml:6: 'p w' is not a gear pair
  why: a pair is written as two wheels separated by a tilde
  fix: write `p ~ w`

# a pair with a hyphen: |[p ~ w]|[p-w]|
error: my.yaml:6: 'p-w' is not a gear pair
  why: a pair is written as two wheels separated by a tilde
  fix: write `p ~ w`

# pairs that are not a list: |[p ~ w]|p ~ w|
error: my.yaml:6: `gears` is not a list in brackets
  why: the given value is 'p ~ w'
  fix: for example, write `gears: [m ~ h]`

# links instead of wheels: |[p ~ w]|[a ~ w]|
error: my.yaml:6: no wheel 'a'
  why: 'a' is a link, and a pair names two wheels
  fix: write one of its wheels: p

# a carrier without turning pair: |  b: {wheels|  carrier: {}\n  b: {wheels|
error: my.yaml:4: link 'carrier' is not connected to the frame
  why: no chain of turning pairs leads from it to 'frame'
  fix: add it to an axis of `revolutes`, or declare an axis of its own: `carrier: [frame, carrier]`

# teeth in words: |p: 20|p: twenty|
error: my.yaml:3: `links.a.wheels.p.teeth`: 'twenty' is not a tooth count
  fix: write a whole number from 1 to 10^12, such as 20

# teeth with a word: |p: 20|p: 20 teeth|
error: my.yaml:3: `links.a.wheels.p.teeth`: '20 teeth' is not a tooth count
  fix: write the number only: 20

# teeth of a link: |a: {wheels: {p: 20}}|a: {teeth: 20}|
error: my.yaml:3: unknown key 'teeth'
  why: `links.a` accepts only known keys, so that a misspelt key is not ignored
  fix: write `a: {wheels: {w: 20}}`: teeth belong to a wheel, here named w

# a link as a number: |a: {wheels: {p: 20}}|a: 20|
error: my.yaml:3: `links.a` is not a mapping of keys to values
  why: the given value is '20'
  fix: for example, write `a: {wheels: {m: 6}}`

# no input: |inputs: {a: 1}\n||
my: free: 1 degree of freedom and no input: speeds of a, b are undetermined; prescribe an input, such as a (my.yaml:1)
  frame                     0  0
  b              undetermined  -  FAILS: -1/3 is expected

# an input too many: |{a: 1}|{a: 1, b: 2}|
my: contradictory: a = 1, b = 2 contradict each other: 1 a + 3 b must be 0 and is 7 (my.yaml:7)
  b          undetermined  -  FAILS: -1/3 is expected

# an output of an unknown link: |outputs: {b:|outputs: {hour:|
error: my.yaml:8: no link 'hour'
  why: `outputs.hour` refers to it
  fix: use one of: frame, a, b; or declare `links: {hour: {}}`

# outputs as a list: |outputs: {b: {expect: -1/3}}|outputs: [b]|
error: my.yaml:8: `outputs` is not a mapping of keys to values
  why: the given value is ['b']
  fix: for example, write `outputs: {hour: {expect: -1}}`

# a tab: |  a: {wheels|\ta: {wheels|
error: my.yaml:3: the line contains a tab
  why: YAML is indented with spaces only
  fix: replace the tab with spaces

# an indentation: |  a: {wheels| a: {wheels|
error: my.yaml:3: invalid YAML syntax
  why: a key and a colon are expected here, with the same indentation as the keys above
  fix: write `key: value`, and indent all keys of a mapping equally

# no colon: |a: {wheels: {p: 20}}|a {wheels: {p: 20}}|
error: my.yaml:3: invalid YAML syntax
  why: a key and a colon are expected here, with the same indentation as the keys above
  fix: write `key: value`, and indent all keys of a mapping equally

# no space after a colon: |{p: 20}|{p:20}|
error: my.yaml:3: no space after the colon in `p:20`
  why: without a space the colon is part of the key
  fix: write `p: 20`

# a key twice: |inputs: {a: 1}|inputs: {a: 1}\ninputs: {b: 1}|
error: my.yaml:8: key 'inputs' is given twice
  why: it is also at my.yaml:7, and one of the two values would be lost
  fix: rename or remove one of the two keys

# a pair with a tilde as the value of `pair`: |gears: [p ~ w]|gears: [{pair: p ~ w, efficiency: 0.98}]|
error: my.yaml:6: `gears[0].pair` is not a list in brackets
  why: the given value is 'p ~ w'
  fix: for example, write `pair: [p, w]`

# a pair that has only an id: |gears: [p ~ w]|gears: [{id: p~w, efficiency: 0.98}]|
error: my.yaml:6: key 'pair' is missing
  why: `gears[0]` requires it
  fix: add `pair: [p, w]`

# an input that is a wheel: |inputs: {a: 1}|inputs: {p: 1}|
error: my.yaml:7: no link 'p'
  why: 'p' is a wheel of the link 'a'
  fix: write 'a'

# a speed in turns a year: |inputs: {a: 1}|inputs: {a: 1 turn/year}|
error: my.yaml:7: `inputs.a`: '1 turn/year' has an unknown unit
  fix: a calendar unit has several lengths: declare it for all speeds, such as `unit: {per: year_tropical_J2000}`, and write numbers without a unit

# a target that is a number: |expect: -1/3|targets: [5/19]|
error: my.yaml:8: unknown astronomical period '5/19'
  why: a target given as a string is a name in the table of periods
  fix: write a speed as `{speed: 5/19}`, a time as `{period: 365.25 d}`, turns as `{name: NAME, turns: 5}`

# a key that is misspelt: |inputs:|input:|
error: my.yaml:7: unknown key 'input'
  why: the declaration accepts only known keys, so that a misspelt key is not ignored
  fix: did you mean 'inputs'?
"""  # noqa: E501
"""Each mistake: its name, the replaced text in the declaration and its replacement, then the message in full."""

NAMES = {
    "planetery": """\
error: planetery: the file does not exist
  why: 'planetery' is not the name of a shipped train either
  fix: did you mean 'planetary' or 'norton-planetary' or 'planetary-24-18-60'?
""",
    "quux.yaml": """\
error: quux.yaml: the file does not exist
  why: 'quux' is not the name of a shipped train either
  fix: check the path; `geartrain list` shows the shipped trains
""",
}


@pytest.mark.parametrize("mistake", MISTAKES[3:].split("\n\n# "), ids=lambda text: text.partition(":")[0])
def test_a_mistake_is_explained(mistake: str) -> None:
    head, message = mistake.split("\n", 1)
    old, new = (text.replace("\\n", "\n").replace("\\t", "\t") for text in head.split("|")[1:3])
    assert SOUND.count(old) == 1
    Path("my.yaml").write_text(SOUND.replace(old, new), encoding="utf-8")
    done = ended("solve", "my.yaml")
    assert done.returncode in (1, 2)
    assert (done.stderr or done.stdout) == message.rstrip() + "\n"


@pytest.mark.parametrize("name", NAMES)
def test_a_name_that_is_not_found_is_explained(name: str) -> None:
    done = ended("solve", name)
    assert (done.returncode, done.stderr) == (2, NAMES[name])


def test_a_name_without_its_suffix_is_explained() -> None:
    Path("my.yaml").write_text(SOUND, encoding="utf-8")
    done = ended("solve", "my")
    assert done.returncode == 2
    assert "fix: give the name with its suffix: my.yaml" in done.stderr


@pytest.mark.parametrize("command", ["view", "report", "compare"])
def test_a_file_of_a_train_that_is_not_as_expected_is_written_with_a_note(command: str) -> None:
    for expected, code in (("-1/3", 0), ("1/3", 1)):
        Path("my.yaml").write_text(SOUND.replace("-1/3", expected), encoding="utf-8")
        done = ended(command, "my.yaml", "-o", f"{expected.replace('/', '')}.html")
        assert done.returncode == code
        assert ("`geartrain check` lists why" in done.stderr) == (code == 1)
