"""An orrery: several periods from one arbor through a tree of gear pairs, with its wheels and its exact errors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from geartrain.numerics.exact import as_float, fraction_text
from geartrain.numerics.results import Key, Result


@dataclass(frozen=True, slots=True)
class OrreryArbor(Result):
    """One arbor of an orrery.

    Attributes
    ----------
    name : str
        The period it shows, or `arbor 1`, `arbor 2`...; the caller names the first.
    period : Fraction
        Turns of the first arbor in one of its own, exact and positive.
    sense : {-1, 1}
        1 with the first arbor, -1 against it: every pair is external and reverses.
    wheels : tuple of int
        Tooth counts of its wheels, ascending, all different.
    shows : bool
        True if it shows a period that was asked for.
    """

    KEYS = ("name", "period", Key("value", "period", as_float), "sense", "wheels", "shows")

    name: str
    period: Fraction
    sense: int
    wheels: tuple[int, ...]
    shows: bool


@dataclass(frozen=True, slots=True)
class OrreryPair(Result):
    """One gear pair: teeth of the driver on arbor `parent`, and of the driven wheel on arbor `child`."""

    driver: int
    driven: int
    parent: str
    child: str


@dataclass(frozen=True, slots=True)
class Orrery(Result):
    """A tree of gear pairs that shows every period asked for.

    Attributes
    ----------
    periods : mapping of str to Fraction
        Name -> period asked for [turns of the first arbor].
    tolerances : mapping of str to Fraction
        Name -> greatest relative error asked for.
    arbors : tuple of OrreryArbor
        The first arbor first, every other after the one that drives it.
    pairs : tuple of OrreryPair
        In the order of the driven arbors.
    errors : mapping of str to Fraction
        Name -> speed over wanted speed, less 1, exact; positive is fast.
    least_pairs : int
        No tree of fewer pairs shows all the periods: proved by walking all of them.
    least_wheels : int
        Fewer wheels than this are impossible: proved.
    ended : {"proved", "effort", "time", "interrupted"}
        Why the search ended.

    See Also
    --------
    find_orrery : finds it.
    """

    KEYS = (
        "wheels",
        "pairs",
        "arbors",
        Key("errors", keys=(Key("value", ".", float), Key("exact", "."))),
        "least_pairs",
        "least_wheels",
        "complete",
        "ended",
    )

    periods: Mapping[str, Fraction]
    tolerances: Mapping[str, Fraction]
    arbors: tuple[OrreryArbor, ...]
    pairs: tuple[OrreryPair, ...]
    errors: Mapping[str, Fraction]
    least_pairs: int
    least_wheels: int
    ended: str

    @property
    def wheels(self) -> int:
        """Number of wheels; one that meshes with several counts once."""
        return sum(len(arbor.wheels) for arbor in self.arbors)

    @property
    def complete(self) -> bool:
        """True if it is proved that no orrery has fewer wheels."""
        return self.wheels <= self.least_wheels

    @property
    def worst(self) -> Fraction:
        """Greatest relative error in magnitude."""
        return max(map(abs, self.errors.values()))

    def to_train(self, name: str = "orrery", unit: str = "d") -> dict[str, Any]:
        """A declaration as plain data: the first arbor turns once a `unit`, every output expects its exact speed.

        A shared wheel is one wheel in several gear pairs. All arbors stand in one frame on axes of their own.

        Parameters
        ----------
        name : str
            Of the train.
        unit : str
            The time in which the first arbor turns once, such as "d".
        """
        places = {arbor.name: at for at, arbor in enumerate(self.arbors)}
        links: dict[str, Any] = {"frame": {}}
        for at, arbor in enumerate(self.arbors):
            links[arbor.name] = {"wheels": {_wheel(at, count): count for count in arbor.wheels}}
        gears = [
            {"pair": [_wheel(places[pair.parent], pair.driver), _wheel(places[pair.child], pair.driven)]}
            for pair in self.pairs
        ]
        outputs = {
            arbor.name: {
                "expect": str(Fraction(arbor.sense) / arbor.period),
                "targets": [
                    {
                        "period": f"{_plain(self.periods[arbor.name])} {unit}",
                        "tolerance": _plain(self.tolerances[arbor.name]),
                    }
                ],
            }
            for arbor in self.arbors
            if arbor.shows
        }
        return {
            "name": name,
            "frame": "frame",
            "unit": {"per": f"1 {unit}"},
            "links": links,
            "revolutes": [{"pair": ["frame", arbor.name], "axis": arbor.name} for arbor in self.arbors],
            "gears": gears,
            "inputs": {self.arbors[0].name: 1},
            "outputs": outputs,
        }


def _wheel(arbor: int, count: int) -> str:
    """Name of a wheel: `a3-120` has 120 teeth and sits on arbor 3."""
    return f"a{arbor}-{count}"


def _plain(value: Fraction) -> str:
    """Exact text: a decimal where it ends soon, else a fraction."""
    for digits in range(19):
        scaled = value * 10**digits
        if scaled.denominator == 1:
            whole = str(scaled.numerator).rjust(digits + 1, "0")
            return f"{whole[:-digits]}.{whole[-digits:]}" if digits else whole
    return fraction_text(value)
