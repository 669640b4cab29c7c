"""Wheels on which a function depends through one monomial only."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from geartrain.kinematics.formulas.laurent import Exponents, Laurent
from geartrain.numerics.plain_data import Key, Result

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class MonomialGroup(Result):
    """Wheels of one class: the function sees only x, the product of their counts to the powers `exponents`.

    wheels      in the order declared
    exponents   not 0; usually 1 or -1, the first positive
    degree      greatest power of x in the function's numerator or denominator; 1 makes it a Moebius function of x
    """

    KEYS = (Key("exponents", "by_wheel"), "degree")

    wheels: tuple[str, ...]
    exponents: Exponents
    degree: int

    @property
    def by_wheel(self) -> dict[str, int]:
        """The exponents by wheel."""
        return dict(zip(self.wheels, self.exponents, strict=True))

    @property
    def roundings(self) -> int:
        """Roundings in one `monomials`: its relative error is below this times 2^-53, but for its square."""
        return sum(map(abs, self.exponents))

    def monomials(self, columns: Mapping[str, Any]) -> NDArray[np.float64]:
        """x of many assignments (wheel -> counts, which broadcast); see `roundings` for the error."""
        import numpy as np

        top: NDArray[np.float64] = np.ones(())
        bottom = top
        for wheel, power in zip(self.wheels, self.exponents, strict=True):
            column = np.asarray(columns[wheel]).astype(np.float64)
            for _ in range(abs(power)):
                if power > 0:
                    top = top * column
                else:
                    bottom = bottom * column
        return np.asarray(top / bottom, dtype=np.float64)


@dataclass(frozen=True, slots=True)
class MonomialGrouping:
    """Polynomials rewritten in as few monomials as they allow, up to one common monomial.

    members     for each group, variable -> its exponent in the group's monomial
    rewritten   the polynomials in the groups' monomials, all powers >= 0
    """

    members: tuple[Mapping[int, int], ...]
    rewritten: tuple[Laurent, ...]

    def back(self, p: Laurent, width: int) -> Laurent:
        """A polynomial in the groups' monomials as one in the first variables."""

        def spread(exponents: Exponents) -> Exponents:
            full = [0] * width
            for members, power in zip(self.members, exponents, strict=True):
                for variable, step in members.items():
                    full[variable] = power * step
            return tuple(full)

        return Laurent(width, {spread(exponents): value for exponents, value in p.terms.items()})


Member = TypeVar("Member")


def proportional_classes(lists: Iterable[tuple[Member, Sequence[int]]]) -> dict[Exponents, dict[Member, int]]:
    """Keys whose lists of whole numbers are multiples of one list: that list -> each key with its multiple.

    The lists of the classes have no common divisor, and begin with a positive number beside zeros. Keys with nothing
    but zeros are in none.
    """
    classes: dict[Exponents, dict[Member, int]] = {}
    for key, steps in lists:
        # multiples of one list are the same list once divided by their common divisor and sign
        size = math.gcd(*steps)
        if size:
            size = size if next(step for step in steps if step) > 0 else -size
            classes.setdefault(tuple(step // size for step in steps), {})[key] = size
    return classes


def find_grouping(polynomials: Sequence[Laurent]) -> MonomialGrouping:
    """The coarsest classes of variables such that a quotient of the polynomials sees each through one monomial.

    Dividing all by one monomial changes no quotient, so only differences of exponents count. A monomial of a class
    stays the same along all directions that change its variables alone if and only if their differences, listed
    over all terms, are multiples of one list. For a quotient in lowest terms no coarser classes exist.
    """
    terms = [exponents for p in polynomials for exponents in p.terms]
    columns = enumerate(zip(*terms, strict=True))
    classes = proportional_classes((variable, [power - powers[0] for power in powers]) for variable, powers in columns)
    members = []
    lists = []
    for list_, found in classes.items():
        sign = 1 if next(iter(found.values())) > 0 else -1
        members.append({variable: sign * size for variable, size in found.items()})
        least = min(sign * step for step in list_)
        lists.append([sign * step - least for step in list_])
    powers_of: Iterator[Exponents] = iter(zip(*lists, strict=True) if lists else [()] * len(terms))
    rewritten = tuple(
        Laurent(len(members), {next(powers_of): value for value in p.terms.values()}) for p in polynomials
    )
    return MonomialGrouping(tuple(members), rewritten)
