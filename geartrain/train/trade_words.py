"""Words of clockmakers and historians for the engineering terms in messages and pages."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

_MOST_WORDS = 4


class TradeWord(NamedTuple):
    """One term in the words of engineers, of clockmakers, and of historians of old mechanisms."""

    engineer: str
    maker: str
    historian: str

    def __str__(self) -> str:
        same = self.maker == self.historian
        return f"{self.engineer}: {self.maker}" if same else f"{self.engineer}: {self.maker}, or {self.historian}"


TRADE_WORDS = (
    TradeWord("link", "an arbor with all that is fixed on it", "an axle with its gears"),
    TradeWord("frame", "the plates", "the case and its plates"),
    TradeWord("turning pair", "a pivot in its hole, or an arbor in a pipe", "the bearing of an axle"),
    TradeWord("gear pair", "a wheel and a pinion in mesh", "two gears that engage"),
    TradeWord("coupling", "a pin in a slot", "a pin-and-slot device"),
    TradeWord("carrier", "a platform that goes round with arbors on it", "a turntable or epicyclic platform"),
    TradeWord("planet", "a wheel on a stud that is carried round", "an epicyclic gear"),
    TradeWord("circuit", "a mesh with the pivots between its wheels", "two gears and the axles that hold them apart"),
    TradeWord("mobility", "the number of cranks or weights needed", "the number of cranks to be turned by hand"),
    TradeWord("input", "the arbor driven by hand, weight or spring", "the crank"),
    TradeWord("output", "the arbor of a hand", "a pointer"),
    TradeWord("clutch", "two arbors coupled when wanted", "two axles coupled when wanted"),
)
"""Terms that are explained where a message or page uses them."""

_PLURALS = {"mobility": "mobilities", "clutch": "clutches"}
_SPOKEN = {
    word: re.compile(rf"\b(?:{word.engineer}s?|{_PLURALS.get(word.engineer, word.engineer)})\b", re.IGNORECASE)
    for word in TRADE_WORDS
}


def trade_words(text: str) -> Iterator[TradeWord]:
    """Return the terms that occur in a text. Names in quotes and code are skipped because they are the user's own."""
    text = re.sub(r"`[^`]*`|'[^']*'", " ", text)
    return (word for word in TRADE_WORDS if _SPOKEN[word].search(text))


def told_words(text: str) -> str:
    """Return one line that explains the terms of a message; empty if it contains none of them."""
    found = [str(word) for word in trade_words(text)][:_MOST_WORDS]
    return f"words: {'; '.join(found)}" if found else ""
