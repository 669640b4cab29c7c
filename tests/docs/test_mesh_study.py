"""The study of transmission functions: errors fall with samples, every function is built anew. Times are not judged."""

from __future__ import annotations

import pytest
from studies.mesh_study import MeshRecords, _Pair, meshes

pytestmark = pytest.mark.slow  # the script of an accuracy page, no part of the package


@pytest.fixture(scope="module")
def records() -> MeshRecords:
    return meshes(quick=True)


def errors(records: MeshRecords, quantity: str, word: str) -> dict[tuple[str, str], float]:
    return {
        (row.family, row.method): row.error
        for row in records.rows
        if row.quantity == quantity and word in row.method and row.error is not None
    }


def test_the_formula_is_right_to_rounding(records: MeshRecords) -> None:
    found = errors(records, "error", "direct")
    assert len(found) == 2
    assert max(found.values()) < 1e-13


def test_more_samples_err_less_and_the_table_keeps_its_tolerance(records: MeshRecords) -> None:
    for pair in ("48/96", "3/7"):
        sampled = errors(records, "error", "sampled")
        assert sampled[pair, "sampled, 1000"] < sampled[pair, "sampled, 100"] / 5
        assert errors(records, "error", "tabulated")[pair, "tabulated"] < 1e-12


def test_each_law_is_built_anew() -> None:
    pair = _Pair(48, 96, 30, 0.01, 10)
    assert pair.build("direct").contact is not pair.build("direct").contact
