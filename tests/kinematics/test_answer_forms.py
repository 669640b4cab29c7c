"""What an answer and a system can tell: by name, in words, as HTML, as text and as LaTeX."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest
from hypothesis import given
from strategies import Data, driven_trains

from geartrain import GearTrain, Verdict, load

BRANCHED = """
links:
  frame: {}
  <in>: {wheels: {p: 20}}
  out_1: {wheels: {w: 60}}
  idle: {}
revolutes: {A: [frame, <in>], B: [frame, out_1], C: [frame, idle]}
gears: [{pair: [p, w]}]
inputs: {<in>: 1/2}
outputs: {<result>: {of: out_1, expect: -1/6}}
"""


def test_results_are_found_by_output_or_link() -> None:
    answer = load(BRANCHED).solve()
    assert answer["<result>"] == answer["out_1"] == Fraction(-1, 6)
    with pytest.raises(KeyError, match="idle"):
        answer["idle"]
    with pytest.raises(KeyError, match="nothing"):
        answer["nothing"]


def test_an_idle_link_is_free_and_the_rest_is_still_answered() -> None:
    answer = load(BRANCHED).solve()
    assert answer.verdict.kind == "free"
    assert answer.verdict.links == ("idle",)
    assert answer.verdict.fixes == ("idle",)
    assert not answer, "a free train is no success"
    assert load(BRANCHED).solve(output="<result>"), "but the output asked for is determined"


def test_only_a_determined_verdict_is_true() -> None:
    kinds = ("determined", "free", "locked", "contradictory")
    assert [bool(Verdict(kind, "")) for kind in kinds] == [True, False, False, False]  # type: ignore[arg-type]


@given(driven_trains())
def test_equations_as_text_say_what_the_rows_say(data: Data) -> None:
    train = GearTrain.declare(data)
    system, speeds = train.equations(), train.solve().speeds
    lines = system.text().splitlines()
    assert len(lines) == len(system.equations)
    for line, equation in zip(lines, system.equations, strict=True):
        assert line.startswith(equation.label)
        left, right = line.removeprefix(equation.label).split(" = ")
        total = Fraction(0)
        for sign, size, link in re.findall(r"([-+]?) ?(\d*) ?w\[(\w+)\]", left):
            total += (-1 if sign == "-" else 1) * int(size or 1) * speeds[link]
        assert total == Fraction(right) == equation.right


def test_equations_as_latex_escape_what_latex_would_read() -> None:
    latex = load(BRANCHED).equations().latex()
    assert latex.startswith("\\begin{align}")
    assert latex.rstrip().endswith("\\end{align}")
    assert r"20 \omega_{\text{<in>}} + 60 \omega_{\text{out\_1}} - 80 \omega_{\text{frame}} &= 0" in latex
    assert r"\frac{1}{2}" in latex
    assert latex.count("&=") == 3


def test_the_frame_and_every_prescription_have_a_row_of_their_own() -> None:
    train = load("planetary")
    kinds = {state: [row.kind for row in train.equations(state).equations] for state in train.states}
    assert kinds["ring fixed"] == ["frame", "gear", "gear", "fixed", "input"]
    assert kinds["direct drive"] == ["frame", "gear", "gear", "lock", "input"]
    assert kinds["two inputs"] == ["frame", "gear", "gear", "input", "input"]
