"""`mesh --objective` and `--vary radii`: what is told, limits with units, what is refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from commands import call

PAIR = ("mesh", 48, 96, "--form", "triangular")
BEST = (*PAIR, "--friction", "0.2", "--objective", "loss", "--free", "window=0.4:0.6")


def test_the_page_tells_the_sizes_as_a_declaration_has_them() -> None:
    done = call(*BEST, "-p", "radii=0.98")
    assert done.exit_code == 0, done.output
    told = " ".join(done.stdout.split())
    assert "{form: triangular, half_angle: 30 deg, window: 0." in told
    assert "radii: 0.98}" in told
    assert "The wheels turn" in told


def test_limits_have_units_and_are_kept() -> None:
    requested = (*BEST, "-p", "radii=0.98", "--within", "error=0.0474deg", "--within", "jam=0.9", "--json")
    best = json.loads(call(*requested).stdout)["best"]
    assert best["error"] <= 0.0474 * 0.017453292519943295
    assert best["jam"] >= 0.9
    assert 0.4 <= best["window"] <= 0.6


def test_a_chance_is_told_with_the_errors_it_is_of() -> None:
    done = call(*BEST, "-p", "radii=0.98", "--within", "stops=5%", "--cutting", "pitch_deviation=1 %")
    assert "jams or clashes in 0 % of the trials" in " ".join(done.stdout.split()), done.output


def test_a_picture_of_the_designs_and_of_a_front(tmp_path: Path) -> None:
    for aims in ("loss", "loss,error"):
        picture = tmp_path / f"{aims}.svg"
        done = call(*PAIR, "--friction", "0.2", "--objective", aims, "--free", "window=0.4:0.6", "--plot", picture)
        assert done.exit_code == 0, done.output
        assert ("front" in picture.read_text(encoding="utf-8")) is (aims == "loss,error")


def test_radii_are_varied_as_one_number() -> None:
    done = call(*PAIR, "-p", "window=0.5", "--friction", "0.2", "--vary", "radii=0.94:1:4")
    rows = [line.split(",") for line in done.stdout.splitlines()]
    assert rows[0][0] == "radii"
    assert [round(float(row[0]), 3) for row in rows[1:]] == [0.94, 0.96, 0.98, 1.0]


def test_one_number_stands_for_two_radii() -> None:
    sizes = [
        json.loads(call(*PAIR, "-p", "window=0.5", "-p", f"radii={radii}", "--json").stdout)["sizes"]["radii"]
        for radii in ("1", "pitch_true", "49/50")
    ]
    assert sizes[0] == sizes[1] == [1.0, 2.0]
    assert sizes[2] == pytest.approx([1.0, 1.96], rel=1e-15)
