"""Speed of an output as a formula in tooth counts and the speeds of the inputs."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.errors import check_choice
from geartrain.kinematics.formulas.closed_forms import ClosedForm
from geartrain.kinematics.formulas.output_formulas import find_formulas
from geartrain.numerics.results import Result

if TYPE_CHECKING:
    from sympy import Expr

    from geartrain.train import Train


@dataclass(frozen=True)
class InputShare(Result):
    """Contribution of one input to the speed of an output, which is the ratio times the speed of the input."""

    input: str
    """Name of the input link."""
    speed: Fraction
    """Declared speed of the input [the train's unit of speed]."""
    ratio: ClosedForm
    """Speed of the output divided by the speed of the input while all other inputs are at rest."""


@dataclass(frozen=True)
class OutputFormula(Result):
    """Speed of an output as the sum of the contributions of all inputs, each of which is a ratio times the speed of the
    input.

    See Also
    --------
    geartrain.GearTrain.formula : method that returns it
    """

    KEYS = ("output", "state", "text", "latex", "value", "shares", "conditions", "poles")

    output: str
    """Name of the output whose speed the formula gives."""
    state: str | None
    """Name of the state; None for a train without states."""
    shares: tuple[InputShare, ...]
    """Contribution of each input on which the output depends."""
    conditions: tuple[str, ...] = ()
    """Equations between tooth counts that must be satisfied so that the loops of the train can turn."""
    poles: tuple[str, ...] = ()
    """Equations between tooth counts under which the output is locked or free."""

    def _summary(self) -> str:
        names = ", ".join(share.input for share in self.shares)
        state = "" if self.state is None else f" in state {self.state}"
        return f"{self.output}{state} by {names or 'no input'}"

    def __str__(self) -> str:
        """Return the formula as text."""
        return self.text

    _repr_html_ = None  # type: ignore[assignment]  # notebooks show the formula

    def _repr_latex_(self) -> str:
        return f"${self.latex}$"

    @property
    def ratio(self) -> ClosedForm:
        """Speed of the output divided by the speed of the input, for an output that depends on exactly one input.

        Raises
        ------
        ValueError
            If the output depends on several inputs, or on none.
        """
        (share,) = self.shares
        return share.ratio

    @property
    def value(self) -> Fraction | None:
        """Speed at the declared tooth counts and input speeds [the train's unit of speed]; None if it is not
        determined.
        """
        values = [share.ratio.value for share in self.shares]
        if any(value is None for value in values):
            return None
        return sum((share.speed * (share.ratio.value or 0) for share in self.shares), Fraction(0))

    @property
    def text(self) -> str:
        """Formula as text, such as `carrier = z_s/(z_s + z_r) · sun`; the name of a link denotes its speed."""
        return f"{self.output} = {self._sum('text', str)}"

    @property
    def latex(self) -> str:
        """Formula in LaTeX."""
        return f"{_speed_symbol(self.output)} = {self._sum('latex', _speed_symbol)}"

    def sympy(self) -> Expr:
        """Return the speed as a SymPy expression with symbols `z_...` for tooth counts and `w_...` for input speeds.

        Raises
        ------
        MissingExtraError
            If SymPy (extra `sympy`) is not installed.
        """
        parts = [share.ratio.sympy() for share in self.shares]
        import sympy

        return sympy.Add(
            *(part * sympy.Symbol(f"w_{share.input}") for part, share in zip(parts, self.shares, strict=True))
        )

    def _sum(self, style: str, speed: Callable[[str], str]) -> str:
        words = ""
        for share in self.shares:
            part = _times(getattr(share.ratio, style), speed(share.input), style)
            words += part if not words else f" - {part[1:]}" if part.startswith("-") else f" + {part}"
        return words or "0"


def _times(ratio: str, speed: str, style: str) -> str:
    """Return the product of a ratio and a speed as text, with brackets if the ratio is a sum."""
    if ratio in ("1", "-1"):
        return ratio[:-1] + speed
    dot = " · " if style == "text" else r"\,"
    # brackets are removed to a depth of two: only signs outside them make the ratio a sum
    outside = re.sub(r"\([^()]*\)|\{[^{}]*\}", "", re.sub(r"\([^()]*\)|\{[^{}]*\}", "", ratio))
    if " + " not in outside and " - " not in outside:
        return ratio + dot + speed
    return (f"({ratio})" if style == "text" else rf"\left({ratio}\right)") + dot + speed


def speed_formulas(train: Train, state: str | None, outputs: Sequence[str] = ()) -> Iterator[OutputFormula]:
    """Yield the formulas of all outputs of a state, or only of the given `outputs`, in the order of declaration.

    Undetermined outputs are omitted. All declared tooth counts are variables.
    """
    case = train.case(state)
    for name in outputs:
        check_choice("output", name, case.outputs)
    counts = {name: wheel.count for name, (_, wheel) in train.wheels.items() if wheel.count}
    free = {name: (count,) for name, count in counts.items()}
    # superposition: one solution for a unit speed of each input, with the others at rest
    units = {link: dict.fromkeys(case.inputs, 0) | {link: 1} for link in case.inputs}
    found = {link: find_formulas(train, state, free, unit) for link, unit in units.items()}
    for name in outputs or case.outputs:
        if found and all(name in each for each in found.values()):
            shares = tuple(
                InputShare(link, case.inputs[link], ClosedForm(each[name], counts)) for link, each in found.items()
            )
            # equations, without duplicates
            required: dict[str, None] = {}
            poles = dict.fromkeys(text for share in shares for text in share.ratio.poles)
            for formulas in found.values():
                for texts, functions in ((required, formulas.conditions), (poles, formulas.exclusions)):
                    texts.update(dict.fromkeys(text for each in functions for text in ClosedForm(each, counts).zeros))
            shown = tuple(share for share in shares if share.ratio.formula.numerator)
            yield OutputFormula(name, state, shown, tuple(required), tuple(poles))


def _speed_symbol(link: str) -> str:
    return r"\omega_{\mathrm{" + link.replace("_", r"\_") + "}}"
