"""Ranges written out and distinct quotients, against plain loops."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geartrain.search.integer_columns import distinct_quotients, spread, spread_in_blocks

ranges = st.lists(st.tuples(st.integers(-5, 5), st.integers(0, 6)), max_size=6)


@given(ranges, st.integers(1, 9))
def test_ranges_are_written_out_in_order_and_in_blocks_that_join(given_: list[tuple[int, int]], most: int) -> None:
    starts = np.array([start for start, _ in given_], dtype=np.int64)
    ends = starts + np.array([size for _, size in given_], dtype=np.int64)
    truth = [(at, number) for at, (start, size) in enumerate(given_) for number in range(start, start + size)]
    assert list(zip(*(column.tolist() for column in spread(starts, ends)), strict=True)) == truth
    blocks = [list(zip(*(c.tolist() for c in block), strict=True)) for block in spread_in_blocks(starts, ends, most)]
    assert [pair for block in blocks for pair in block] == truth
    assert all(len(block) <= most for block in blocks)


whole = st.one_of(st.integers(-12, 12), st.integers(-(10**30), 10**30))


@pytest.mark.parametrize("dtype", [np.int64, object])
@given(data=st.data())
def test_equal_quotients_are_one_whatever_their_terms_and_signs(dtype: Any, data: st.DataObject) -> None:
    numbers = whole if dtype is object else st.integers(-12, 12)
    pairs = data.draw(st.lists(st.tuples(numbers, numbers.filter(bool)), max_size=12))
    above, below = (np.array([pair[at] for pair in pairs], dtype=dtype) for at in (0, 1))
    quotients, which = distinct_quotients(above, below)
    assert [quotients[at] for at in which] == [Fraction(n, d) for n, d in pairs]
    assert len(set(quotients)) == len(quotients)
