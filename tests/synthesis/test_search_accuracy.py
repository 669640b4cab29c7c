"""Error against run time of ways to the best radii: errors against radii asked one by one. Times are never judged."""

from __future__ import annotations

import subprocess
import sys

import pytest

from geartrain import GearTrain, load
from geartrain.analysis import MethodAccuracy, find_accuracy
from geartrain.analysis.method_accuracy import OPTIMISATION, AbsentStageError
from geartrain.synthesis.tooth_sizes import search_accuracy
from geartrain.synthesis.tooth_sizes.declared_sizes import declared_sizes, sizeable_meshes
from geartrain.synthesis.tooth_sizes.search_accuracy import measure_optimisation
from geartrain.synthesis.tooth_sizes.size_design import equal_depth_radii

SCANS = ("scan in steps of 1 %", "scan in steps of 0.1 %", "scan, then 0.01 % and Brent")


def triangular(friction: float = 0.2) -> GearTrain:
    """The second pair loses most."""
    wheels = {"a": {"p": 96}, "b": {"w": 96, "q": 20}, "c": {"v": 60}}
    return GearTrain.declare(
        {
            "links": {"frame": {}} | {link: {"wheels": each} for link, each in wheels.items()},
            "revolutes": [{"pair": ["frame", link], "axis": link} for link in "abc"],
            "gears": [{"pair": ["p", "w"]}, {"pair": ["q", "v"]}],
            "tooth_form": {"form": "triangular", "half_angle": "30 deg", "window": "0.5"},
            "friction": friction,
            "inputs": {"a": 1},
        }
    )


@pytest.fixture(scope="module")
def rows() -> dict[str, MethodAccuracy]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(search_accuracy, "_REACH", 0.04)
        found = find_accuracy(triangular(), positions=10, more={OPTIMISATION: measure_optimisation})
    return {row.method: row for row in found.methods if row.stage == OPTIMISATION}


def error_of(row: MethodAccuracy) -> float:
    assert row.error is not None
    return row.error


def test_the_search_is_no_worse_than_a_scan_in_steps_of_a_thousandth(rows: dict[str, MethodAccuracy]) -> None:
    coarse, middle, fine = (rows[scan] for scan in SCANS)
    assert error_of(rows["DIRECT, polished by Brent"]) <= error_of(middle) <= error_of(coarse)
    assert error_of(fine) < 1e-8
    assert min(error_of(row) for row in rows.values()) == 0
    assert len(rows) == 6
    counts = [row.evaluations for row in (coarse, middle, fine)]
    assert all(counts)
    assert counts[0] * 9 < counts[1] < counts[2]  # type: ignore[operator]


def test_errors_are_those_of_radii_asked_one_by_one(rows: dict[str, MethodAccuracy]) -> None:
    """Of the pair that loses most, 20/60: steps of 1 % from the lower end."""
    (start,) = (
        declared_sizes(mesh)
        for name, mesh in sizeable_meshes(triangular().mechanics.meshes_in()).items()
        if "q" in name
    )
    middle = (1 + equal_depth_radii(20, 60, start.half_angles)) / 2
    low, high = 0.96 * middle, 1.04 * middle
    coarse = min(start.at({"radii": low + 0.01 * step}).loss for step in range(int((high - low) / 0.01) + 1))
    row = rows[SCANS[0]]
    assert "20/60" in row.reference
    least = float(row.reference.split(",")[1].strip(" %").replace("%", "")) / 100
    assert error_of(row) == pytest.approx(coarse - least, abs=1e-7)
    assert row.ratio >= 1


@pytest.mark.parametrize(
    ("train", "why"),
    [
        (load("worm"), "no pair has triangular teeth"),
        (load("lantern-mill"), "no pair has triangular teeth"),
        (triangular(friction=0), "under friction"),
    ],
)
def test_a_train_without_teeth_to_size_says_so(train: GearTrain, why: str) -> None:
    with pytest.raises(AbsentStageError, match=why):
        list(measure_optimisation(train, None))


def test_a_train_without_tooth_forms_loads_no_search() -> None:
    code = (
        "import sys; from geartrain.cli import main; sys.argv = ['geartrain', 'bench', 'worm']\n"
        "try: main()\nexcept SystemExit: pass\n"
        "print([name for name in sys.modules if name.startswith('geartrain.synthesis')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
    assert "optimisation: no pair has triangular teeth" in done.stdout


def test_no_way_is_cheaper_for_what_another_has_worked_out() -> None:
    """Windows and contacts are kept between designs; each way works its own out."""
    from geartrain.teeth.triangular import clearance_window

    (start,) = (
        declared_sizes(mesh)
        for name, mesh in sizeable_meshes(triangular().mechanics.meshes_in()).items()
        if "q" in name
    )
    made = []
    for _ in range(2):
        trial = search_accuracy._by_brent(start, (0.93, 0.95))
        made.append((trial.evaluations, clearance_window._window.cache_info().misses))
    assert made[0] == made[1]
    assert made[0][0] == made[0][1] > 5
