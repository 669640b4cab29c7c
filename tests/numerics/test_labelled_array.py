"""What an array with labels shows of itself."""

from __future__ import annotations

import numpy as np

from geartrain.numerics import LabelledArray


def test_a_short_array_shows_all_its_labels() -> None:
    array = LabelledArray(np.array([[1.0, 2.0]]), ("link", "case"), (("<a>",), ("x", "y")))
    assert repr(array) == "<LabelledArray 1 link x 2 case: <a>>"
    assert str(array) == "LabelledArray(values=array([[1., 2.]]), axes=('link', 'case'), labels=(('<a>',), ('x', 'y')))"
    assert array._repr_html_() == (
        "<table><tr><th></th><th>x</th><th>y</th></tr><tr><th>&lt;a&gt;</th><td>1.0</td><td>2.0</td></tr></table>"
    )


def test_a_long_array_shows_both_ends_of_its_labels() -> None:
    array = LabelledArray(np.zeros((2, 20_000)), ("link", "position"), (("a", "b"), tuple(map(str, range(20_000)))))
    assert repr(array) == "<LabelledArray 2 link x 20000 position: a, b>"
    assert len(str(array)) < 1000
    assert "'19999'" in str(array)
    shown = array._repr_html_()
    assert len(shown) < 4000
    assert "<th>19</th><th>…</th><th>19980</th>" in shown
