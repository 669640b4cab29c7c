"""Draw the pictures of docs/images: a worm that turns, a report as a terminal shows it, triangular teeth in contact,
their law, pointers in motion, power that circulates, gears on a sphere, tooth shapes side by side."""

from __future__ import annotations

import subprocess
import sys
from fractions import Fraction
from math import radians
from pathlib import Path

from stills import can_draw, gif, stills

import geartrain
from geartrain.drawing import (
    motion_figure,
    picture,
    power_figure,
    render,
    sphere_figure,
    teeth_figure,
    triangular_figure,
)
from geartrain.dynamics import MotionRun, find_power_flow
from geartrain.scene import build_scene
from geartrain.spherical import GearSphere, from_polyhedron

IMAGES = Path(__file__).resolve().parents[1] / "images"


def main() -> None:
    """Write the pictures."""
    IMAGES.mkdir(exist_ok=True)
    turning()
    teeth()
    pointers()
    power()
    sphere()
    shapes()
    trains()


def turning() -> None:
    """Draw a quarter of a year of the Antikythera mechanism; keep the file if there is no browser."""
    if can_draw():
        turns = [Fraction(73, 10) + Fraction(n, 192) for n in range(48)]
        pictures = list(stills(build_scene(geartrain.load("freeth-2021")), (420, 320), turns, "white"))
        (IMAGES / "turning.gif").write_bytes(gif(pictures, 10))
        print("wrote docs/images/turning.gif")


def trains() -> None:
    """A train in each kind of picture."""
    for kind, name in (
        ("plan", "longcase-clock"),
        ("stick", "zf-8hp70"),
        ("graph", "pennestri-2002"),
        ("lever", "two-k-h-10000"),
        ("dials", "longcase-clock"),
    ):
        figure = picture(geartrain.load(name), kind, turns=Fraction(31, 7))  # type: ignore[arg-type]
        (IMAGES / f"draw-{kind}.svg").write_bytes(render(figure, ".svg"))
        print(f"wrote docs/images/draw-{kind}.svg")
    figure = picture(geartrain.load("cycloidal-reducer"), "plan")
    (IMAGES / "reducer.svg").write_bytes(render(figure, ".svg"))
    print("wrote docs/images/reducer.svg")


def teeth() -> None:
    """The pair of Fig. 5a of Sorge's note: its law, and its wheels in approach."""
    mesh = next(mesh for mesh in geartrain.load("sorge-pairs").meshes if mesh.name == "5a")
    for name, figure in (
        ("law", triangular_figure(mesh.transmission)),
        ("teeth", teeth_figure(mesh.transmission, radians(3))),
    ):
        (IMAGES / f"{name}.svg").write_bytes(render(figure, ".svg"))
        print(f"wrote docs/images/{name}.svg")


def pointers() -> None:
    """The anomalies of pointers of the reconstruction of 2021, and Mars over its whole period."""
    train = geartrain.load("freeth-2021")
    planets = ("mercury", "venus", "mars", "jupiter", "saturn")
    for name, outputs, turns in (("pointers", ("moon", *planets), 79.0), ("mars-period", ("mars",), 284.0)):
        figure = motion_figure(MotionRun(train.motion(outputs=outputs), turns, 100_001))
        (IMAGES / f"{name}.svg").write_bytes(render(figure, ".svg"))
        print(f"wrote docs/images/{name}.svg")


def power() -> None:
    """The power that circulates in Norton's compound train."""
    train = geartrain.load("norton-compound")
    figure = power_figure(find_power_flow(train.torques()), train.name)
    (IMAGES / "power.svg").write_bytes(render(figure, ".svg"))
    print("wrote docs/images/power.svg")


def shapes() -> None:
    """Tooth forms of one pair side by side, as the command draws them."""
    command = [sys.executable, "-m", "geartrain", "mesh", "24", "36", "--compare", "--force"]
    subprocess.run([*command, "--plot", str(IMAGES / "shapes.svg")], check=True, stdout=subprocess.DEVNULL)


def sphere() -> None:
    """The gears of the icosidodecahedron, 20 and 12 teeth."""
    found = GearSphere(from_polyhedron("icosidodecahedron", teeth={"5": 20, "3": 12}))
    (IMAGES / "sphere.svg").write_bytes(render(sphere_figure(*found.pose()), ".svg"))
    print("wrote docs/images/sphere.svg")


if __name__ == "__main__":
    main()
