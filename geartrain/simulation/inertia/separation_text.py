"""Up to which rate a motion holds, in words: where teeth first part."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geartrain.report.document import Section, Table

if TYPE_CHECKING:
    from geartrain.simulation.inertia.separation_rate import SeparationRates


def separation_section(found: SeparationRates) -> Section:
    """The rate of each pair."""
    from geartrain.simulation.inertia.separation_rate import separation_words

    rows = [(each.pair, *separation_words(each)) for each in found.pairs]
    header = ("pair", f"parts from (turn/s of {found.input})", f"at (turns of {found.input})")
    return Section("Up to which rate it holds", tuple(separation_text(found)), (Table(header, rows),))


def separation_text(found: SeparationRates) -> Iterator[str]:
    """Which pair parts first and when, what was searched, and which inertias are not known."""
    yield _first_words(found)
    if found.uncounted:
        yield f"Friction not counted: that of {', '.join(found.uncounted)}."
    if not found.complete:
        yield f"Searched were {found.turns:.6g} turns of '{found.input}', not all after which everything repeats."
    if found.unknown:
        yield f"Counted without inertia, for none is known: {', '.join(found.unknown)}."


def _first_words(found: SeparationRates) -> str:
    from geartrain.simulation.inertia.separation_rate import separation_words

    first = found.first
    if first is None:
        return f"No teeth part, at whatever rate '{found.input}' turns."
    where = f"after {separation_words(first)[1]} turns of '{found.input}'"
    if first.leap:
        return f"Teeth of {first.pair} part at any rate: {where} a speed falls at once, and nothing pulls."
    if not first.rate:
        return (
            f"Teeth of {first.pair} part at any rate, first {where}: neither load nor friction of bearings holds them "
            "together there."
        )
    return (
        f"Holds up to {first.rate:.5g} turn/s of '{found.input}': from there on the teeth of {first.pair} part, "
        f"{where}, for what they drive runs ahead."
    )
