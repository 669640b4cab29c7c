"""Outputs as formulas: printed ones of textbooks, values against exact solving, text read back, laws of derivatives."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import pytest
from sampling import first_few
from shipped import every_train
from shipped import train as load
from test_states import FREE_SET

import geartrain
from geartrain import GearTrain
from geartrain.errors import GearTrainError
from geartrain.numerics.exact import PI


def planetary(inputs: str, fixed: str, output: str) -> GearTrain:
    rest = f"inputs: {{{inputs}: 1}}\nfixed: [{fixed}]\noutputs: {{{output}: {{}}}}\n"
    return geartrain.load(FREE_SET.format(rest=rest))


@pytest.mark.parametrize(
    ("driven", "held", "requested", "written"),
    [
        ("sun", "ring", "arm", "z_s/(z_s + z_r)"),
        ("arm", "ring", "sun", "1 + z_r/z_s"),
        ("ring", "sun", "arm", "z_r/(z_s + z_r)"),
        ("arm", "sun", "ring", "1 + z_s/z_r"),
        ("sun", "arm", "ring", "-z_s/z_r"),
        ("ring", "arm", "sun", "-z_r/z_s"),
    ],
)
def test_the_six_gears_of_a_planetary_set_are_those_of_textbooks(
    driven: str, held: str, requested: str, written: str
) -> None:
    assert planetary(driven, held, requested).formula(requested).ratio.text == written


def wolfrom() -> GearTrain:
    """A set with sun s, ring r1, planets p1 and p2, ring r2."""
    text = FREE_SET.format(rest="inputs: {sun: 1}\noutputs: {out: {}}")
    text = text.replace("p: 18", "p1: 18, p2: 17").replace("r: {teeth", "r2: {teeth").replace("ring:", "out:")
    text = text.replace("[p, r]}", "[p2, r2]}, {pair: [p1, r1]}").replace("[s, p]", "[s, p1]")
    text = text.replace("sun, ring", "sun, out")
    return geartrain.load(text.replace("frame: {}", "frame: {wheels: {r1: {teeth: 60, internal: true}}}"))


@pytest.mark.needs("sympy")
def test_the_expression_of_a_wolfrom_set_is_that_of_engineers() -> None:
    import sympy

    z_s, z_r1, z_p1, z_p2, z_r2 = sympy.symbols("z_s z_r1 z_p1 z_p2 z_r2", positive=True, integer=True)
    ratio = (z_p1 * z_r2 * (z_s + z_r1)) / (z_s * (z_p1 * z_r2 - z_p2 * z_r1))
    assert sympy.simplify(wolfrom().formula("out").ratio.inverse.sympy() - ratio) == 0


def test_a_wolfrom_set_is_as_engineers_write_it() -> None:
    train = wolfrom()
    found = train.formula("out").ratio.inverse
    assert found.text == "(z_p1 z_r2 (z_s + z_r1))/(z_s (z_p1 z_r2 - z_p2 z_r1))"
    assert found.poles == ("z_p1 z_r2 = z_p2 z_r1",)
    assert str(found) == found.text
    assert found._repr_latex_() == f"${found.latex}$"
    assert str(train.formula("out")) == train.formula("out").text
    assert train.formula("out")._repr_latex_().startswith(r"$\omega_{\mathrm{out}} = \frac{")


def test_two_inputs_are_a_sum() -> None:
    train = load("prius-power-split")
    assert train.formula("MG2", "cruising").text == "MG2 = (1 + z_s30/z_r78) · engine - z_s30/z_r78 · MG1"


def formulas_of(train: GearTrain, state: str | None) -> Iterator[Any]:
    return (train.formula(output, state) for output in train.declaration.case(state).outputs)


@pytest.mark.parametrize("name", every_train())
def test_every_formula_of_every_train_gives_what_solving_gives(name: str) -> None:
    train = load(name)
    for state in train.states or (None,):
        answer = train.solve(state)
        if not answer.verdict:
            continue
        for formula in formulas_of(train, state):
            assert formula.value == answer.outputs[formula.output].speed


@pytest.mark.parametrize("name", every_train(dear={"freeth-2021"}, step=2))
def test_every_text_read_as_arithmetic_gives_the_value(name: str) -> None:
    train = load(name)
    state = train.declaration.state_or_first(None)
    for formula in formulas_of(train, state):
        for share in formula.shares:
            wheels = {wheel: Fraction(share.ratio.counts[wheel]) for wheel in share.ratio.formula.wheels}
            assert _read(share.ratio.text, wheels) == share.ratio.value
            assert share.ratio.latex.count("{") == share.ratio.latex.count("}")


@pytest.mark.needs("sympy")
@pytest.mark.parametrize("name", every_train(dear={"freeth-2021"}, step=2))
def test_every_expression_of_sympy_has_the_value(name: str) -> None:
    train = load(name)
    for formula in formulas_of(train, train.declaration.state_or_first(None)):
        for share in formula.shares:
            expression = share.ratio.sympy()
            counts = {f"z_{wheel}": int(share.ratio.counts[wheel]) for wheel in share.ratio.formula.wheels}
            number = expression.subs({symbol: counts[symbol.name] for symbol in expression.free_symbols})
            assert Fraction(int(number.p), int(number.q)) == share.ratio.value


def _read(text: str, wheels: dict[str, Fraction]) -> Fraction:
    numbers = iter(range(len(wheels)))
    values = {}
    for wheel in sorted(wheels, key=len, reverse=True):
        name = f"Z{next(numbers)}"
        values[name] = wheels[wheel]
        text = text.replace(f"z[{wheel}]", name)
        text = re.sub(rf"z_{re.escape(wheel)}(?!\w)", name, text)
    text = re.sub(r"(?<=[\w)]) (?=[\w(])", "*", text).replace("^", "**")
    text = re.sub(r"(?<![\w*])(\d+)(?!\w)", r"F(\1)", text)
    found = eval(text, {"F": Fraction, "π": PI, **values})  # written by the test itself, of names and signs
    return Fraction(found)


@pytest.mark.needs("sympy")
@pytest.mark.parametrize(
    "name", first_few(4, ["wolfrom-175", "simpson-set", "zf-8hp70", "humpage", "price-1974", "freeth-2008"])
)
def test_elasticities_are_the_derivatives_that_sympy_takes(name: str) -> None:
    import sympy

    train = load(name)
    for formula in formulas_of(train, train.declaration.state_or_first(None)):
        for share in formula.shares:
            expression = share.ratio.sympy()
            for symbol in expression.free_symbols:
                found = share.ratio.elasticity(symbol.name.removeprefix("z_"))
                wanted = symbol / expression * sympy.diff(expression, symbol)
                assert sympy.simplify(found.sympy() - wanted) == 0


def test_elasticities_of_a_ratio_sum_to_nothing() -> None:
    """Twice as many teeth everywhere change no ratio (Euler's theorem)."""
    for name in ("wolfrom-175", "gm-4t60", "price-1974", "ravigneaux-set", "longcase-clock"):
        train = load(name)
        for formula in formulas_of(train, train.declaration.state_or_first(None)):
            for share in formula.shares:
                values = [share.ratio.elasticity(wheel).value for wheel in share.ratio.formula.wheels]
                assert sum(value for value in values if value is not None) == 0


def test_where_a_train_locks_is_said_in_counts() -> None:
    """The 8HP in reverse: no ratio where z_r3 z_r4 = z_s3 z_s4, since then it has none."""
    (formula,) = formulas_of(load("zf-8hp70"), "R")
    assert formula.poles == ("z_r4 z_r3 = z_s3 z_s4",)


def test_a_loop_says_what_it_needs() -> None:
    """Three planets declared one by one need equal counts on both sides of each, which all have."""
    formula = load("four-gear-loop").formula("c")
    assert formula.ratio.text == "z_a20/z_c40"


def test_an_output_that_is_not_there_or_not_determined_is_refused_in_words() -> None:
    with pytest.raises(GearTrainError, match="unknown output 'carier'"):
        load("planetary-24-18-60").formula("carier")
    free = geartrain.load(FREE_SET.format(rest="inputs: {sun: 1}\noutputs: {arm: {}}"))
    with pytest.raises(GearTrainError, match="inputs do not determine"):
        free.formula("arm")
