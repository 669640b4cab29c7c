"""One piece of the search: all products beneath in a segment of value, against the products on top that they need.

The pieces are independent, their questions and results plain JSON data, and how they are cut changes no answer.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from math import isqrt
from typing import Any

from geartrain.synthesis.stages.products import Products, multisets
from geartrain.synthesis.stages.question import Question, question_of

BLOCK = 1 << 21
"""Products of one side held at once: what bounds the memory."""
PER_ROW = 3
"""A window costs a search in every row of the tables: it should bring some products for each."""
_FEW = 1000  # solutions that may be made one by one from their products

Range = tuple[int, int]


def task_of(
    question: Question, low: int, high: int, hint: Fraction, bound: tuple[int, Fraction, int] | None = None
) -> dict[str, Any]:
    """The plain data of one piece.

    low, high  products beneath, half-open
    hint       a tolerance within which some of the best may be expected
    bound      first, |error| and sum of a solution that is surely no better than the last one kept
    """
    plain = [bound[0], str(bound[1]), bound[2]] if bound else None
    return {"question": question.plain(), "low": low, "high": high, "hint": str(hint), "bound": plain}


def search_segment(task: Mapping[str, Any]) -> dict[str, Any]:
    """Count the solutions of a piece, exactly, and give its best.

    Result: `count`; `removed`, reason -> pairs of sets within the tolerance that are no solutions; `rows`, the best as
    [what the order asks for, counts on top, counts beneath].
    """
    from geartrain.synthesis.stages.rows import RowFinder
    from geartrain.synthesis.stages.values import ValueFinder

    question = question_of(task["question"])
    plain = task["bound"]
    bound = (plain[0], Fraction(plain[1]), plain[2]) if plain else None
    by_value = listed_by_value(question)
    finder = ValueFinder(question, Fraction(task["hint"]), bound) if by_value else RowFinder(question, bound)
    for beneath, top in blocks(question, task["low"], task["high"]):
        finder.look(beneath, top)
    return finder.result()


def listed_by_value(question: Question) -> bool:
    """True if solutions need not be looked at one by one: what is asked can be seen from their products."""
    return question.by == "error" and question.loose and question.best <= _FEW


def block_of(question: Question) -> int:
    """Products of one side that are held at once: `BLOCK`, or more where even the tables are longer."""
    numbers = max(len(question.top), len(question.beneath))
    return max(BLOCK, PER_ROW * multisets(numbers, (question.stages + 1) // 2))


def blocks(question: Question, low: int, high: int) -> Iterator[tuple[Range, Range]]:
    """Ranges of products beneath and on top that cover every pair within the tolerance once, none too long."""
    if not question.reachable:
        return
    most = block_of(question)
    for beneath in pieces(question.under, *question.beneath_within(low, high), most):
        for top in pieces(question.over, *question.tops_for(*beneath), most):
            yield beneath, top


def pieces(products: Products, low: int, high: int, most: int) -> Iterator[Range]:
    """[low, high) in parts of no more than `most` products each, ascending; nothing where there are none."""
    low, high = max(low, products.least), min(high, products.most + 1)
    number = products.below(high) - products.below(low) if low < high else 0
    if number > most and high - low > 1:
        middle = min(max(isqrt(low * high), low + 1), high - 1)
        yield from pieces(products, low, middle, most)
        yield from pieces(products, middle, high, most)
    elif number:
        yield low, high
