"""Labelled Willis system: one integer equation for each circuit, for the frame, and for each input, brake and lock.

`relative_speed` returns the speed of one link relative to another, exact or as a float.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, overload

from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.circuits.fundamental import WillisEquation
from geartrain.numerics.exact import decimal, fraction_text, integer_factors
from geartrain.numerics.results import Shown
from geartrain.train import StateCase

if TYPE_CHECKING:
    from geartrain.kinematics.judged_outputs import SpeedValue
    from geartrain.kinematics.willis_matrix import WillisMatrix


def axis_sense(of: str, base: str, signs: Mapping[str, int]) -> int:
    """Return 1 if the axes of two links have the same reference sense, and -1 if their reference senses are opposite.

    signs   -1 for links whose axis is opposite to the reference direction of its parallel axes
    """
    return signs.get(of, 1) * signs.get(base, 1)


@overload
def relative_speed(of: str, base: str, speed_of: Callable[[str], Fraction], signs: Mapping[str, int]) -> Fraction: ...


@overload
def relative_speed(
    of: str, base: str, speed_of: Callable[[str], Fraction | None], signs: Mapping[str, int]
) -> Fraction | None: ...


@overload
def relative_speed(
    of: str, base: str, speed_of: Callable[[str], SpeedValue | None], signs: Mapping[str, int]
) -> SpeedValue | None: ...


def relative_speed(
    of: str, base: str, speed_of: Callable[[str], SpeedValue | None], signs: Mapping[str, int]
) -> SpeedValue | None:
    """Return w_of - s w_base, the relative speed about the axis of `of`; None if a speed is not known.

    speed_of   function that returns the speed of a link about its own axis; None if it is not determined
    signs      -1 for links whose axis is opposite to the reference direction; s is the product of the signs of both
    links
    """
    own, other = speed_of(of), speed_of(base)
    if own is None or other is None:
        return None
    return own - other * axis_sense(of, base, signs) if other else own  # usually relative to a link at rest


@dataclass(frozen=True, slots=True)
class WillisSystem(Shown):
    """Willis system of a train in one state, with links as columns and labelled equations as rows.

    The rows are an equation a (w_i - w_k) + b (w_j - w_k) = 0 for each gear pair and coupling (equations (4) and (5) of
    docs/theory.md), one equation for the frame, and one for each input, brake and lock.

    Examples
    --------
    >>> import geartrain
    >>> print(geartrain.load("planetary-24-18-60").equations().text())
    frame      w[frame] = 0
    s~p        24 w[sun] + 18 w[planet] - 42 w[carrier] = 0
    p~ring     18 w[planet] - 60 w[frame] + 42 w[carrier] = 0
    input sun  w[sun] = 1
    """

    links: tuple[str, ...]
    """Links of the columns, in the order of the declaration."""
    equations: tuple[WillisEquation, ...]
    """Equations of the rows, with their labels."""
    exact: bool = True
    """False if radians were converted to turns, or turns to radians. Numbers are then displayed as decimals."""
    redundant: tuple[str, ...] = ()
    """Names of redundant pairs, which close loops with ratio product 1; empty if they were not determined."""
    sliding: frozenset[str] = frozenset()
    """Sliding links of couplings; their speeds are travels in mm."""

    def __str__(self) -> str:
        """Return the equations in the form printed by `geartrain inspect equations`."""
        return self.text()

    def _summary(self) -> str:
        return f"{len(self.equations)} equations in the speeds of {len(self.links)} links"

    def matrix(self, whole: bool = False) -> WillisMatrix:
        """Return the system as a sparse matrix and a right-hand side, for other solvers.

        Parameters
        ----------
        whole : bool
            True to include the column and row of the frame and rows that follow from other rows, as in `text`.
            If it is False, the matrix is square and regular for a determined train.

        Returns
        -------
        WillisMatrix
            Matrix and right-hand side, as a new object at each call.
        """
        from geartrain.kinematics.willis_matrix import build_matrix

        return build_matrix(self.links, self.equations, self.redundant, whole)

    def text(self) -> str:
        """Return the equations as text, one per line."""
        right = fraction_text if self.exact else decimal
        width = max((len(equation.label) for equation in self.equations), default=0)
        return "\n".join(f"{e.label:<{width}}  {self._sum(e.terms)} = {right(e.right)}" for e in self.equations)

    def _sum(self, terms: Sequence[tuple[str, int]]) -> str:
        return _sum([(f"{'x' if link in self.sliding else 'w'}[{link}]", factor) for link, factor in terms], "π")

    def latex(self) -> str:
        """Return the system as a LaTeX `align` environment."""
        right = _fraction if self.exact else decimal

        def left(terms: Sequence[tuple[str, int]]) -> str:
            letters = (("x" if link in self.sliding else r"\omega", _escape(link), factor) for link, factor in terms)
            return _sum([(rf"{letter}_{{\text{{{name}}}}}", factor) for letter, name, factor in letters], r"\pi")

        lines = [f"  {left(e.terms)} &= {right(e.right)} && \\text{{{_escape(e.label)}}}" for e in self.equations]
        return "\\begin{align}\n" + " \\\\\n".join(lines) + "\n\\end{align}"


def assemble_willis_system(
    links: Sequence[str],
    frame: str,
    circuits: Sequence[Circuit],
    case: StateCase | None,
    signs: Mapping[str, int],
    redundant: Sequence[str] = (),
) -> WillisSystem:
    """Assemble the equations of all circuits, of the frame, and of the inputs, brakes and locks in `case`, if it is
    given.

    signs       -1 for links whose axis is opposite to the reference direction of its parallel axes
    redundant   names of pairs whose equations are known to follow from other equations
    """
    rows = [WillisEquation("frame", "frame", ((frame, 1),))]
    rows += [
        # the frame neither turns nor slides: its two coefficients in a travel have different units
        WillisEquation(
            c.id,
            c.kind,
            tuple((link, each * signs.get(link, 1)) for link, each in c.terms if not c.travels or link != frame),
        )
        for c in circuits
    ]
    sliding = frozenset(link for c in circuits if c.travels for link in (c.i, c.bases[0])) - {frame}
    if case is not None:
        # a brake on the frame would repeat the row of the frame
        rows += [WillisEquation(f"fixed {link}", "fixed", ((link, 1),)) for link in case.fixed if link != frame]
        rows += [
            WillisEquation(f"lock {a} {b}", "lock", ((a, signs.get(a, 1)), (b, -signs.get(b, 1))))
            for a, b in case.locks
            if a != b
        ]
        rows += [WillisEquation(f"input {link}", "input", ((link, 1),), speed) for link, speed in case.inputs.items()]
    return WillisSystem(tuple(links), tuple(rows), case is None or case.exact, tuple(redundant), sliding)


def _sum(terms: Sequence[tuple[str, int]], pi: str) -> str:
    parts: list[str] = []
    for symbol, coefficient in terms:
        sign = "-" if coefficient < 0 else "+" if parts else ""
        space = " " if parts else ""
        parts.append(f"{sign}{space}{' '.join([*integer_factors(abs(coefficient), pi), symbol])}")
    return " ".join(parts)


_LATEX = {character: "\\" + character for character in "_&%$#{}"} | {
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "\\": r"\textbackslash{}",
}


def _escape(text: str) -> str:
    return "".join(_LATEX.get(character, character) for character in text)


def _fraction(value: Fraction) -> str:
    if value.denominator == 1:
        return fraction_text(value)
    sign = "-" if value < 0 else ""
    return rf"{sign}\frac{{{fraction_text(abs(value.numerator))}}}{{{fraction_text(value.denominator)}}}"
