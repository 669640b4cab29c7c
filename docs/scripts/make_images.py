"""Draw the pictures of docs/images: a worm that turns, a report as a terminal shows it, triangular teeth in contact,
their law, pointers in motion, power that circulates, gears on a sphere, tooth shapes side by side, results."""

from __future__ import annotations

import subprocess
import sys
from fractions import Fraction
from math import radians
from pathlib import Path
from shutil import copyfile
from tempfile import TemporaryDirectory

from stills import can_draw, gif, stills

import geartrain
from geartrain.drawing import picture, render, sphere_figure
from geartrain.drawing.output_error_plots import motion_figure, torque_cycle_figure
from geartrain.drawing.power_sankey import power_figure
from geartrain.drawing.style import DOT, Row, interval_chart
from geartrain.drawing.tooth_contact import teeth_figure
from geartrain.drawing.transmission_curves import triangular_figure
from geartrain.dynamics import MotionRun, find_power_flow
from geartrain.scene import build_scene
from geartrain.spherical import GearSphere, from_polyhedron
from geartrain.workshop import MonteCarloResult, find_train_sizes, find_trial_plan, read_error_overrides, run_trials
from geartrain.workshop.monte_carlo.monte_carlo_plots import monte_carlo_figure
from geartrain.workshop.sizes.tooth_sizes_plot import train_sizes_figure

IMAGES = Path(__file__).resolve().parents[1] / "images"


def main() -> None:
    """Write the pictures."""
    IMAGES.mkdir(exist_ok=True)
    turning()
    teeth()
    pointers()
    power()
    sphere()
    commands()
    trains()
    results()
    strength()


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
    for stem, name in (("reducer", "cycloidal-reducer"), ("belt", "serpentine-belt"), ("geneva", "film-projector")):
        (IMAGES / f"{stem}.svg").write_bytes(render(picture(geartrain.load(name), "plan"), ".svg"))
        print(f"wrote docs/images/{stem}.svg")


def results() -> None:
    """Charts of results: errors of hand-cut pointers, best sizes of teeth, torque over a turn, motion of a pointer."""
    moon, set_ = geartrain.load("moon-triangular"), geartrain.load("planetary-24-18-60-triangular")
    plan = find_trial_plan(moon, read_error_overrides(["pitch_deviation=1 %"]))
    for name, figure in (
        ("trials", monte_carlo_figure(MonteCarloResult(run_trials(plan, 1000)))),
        ("sizes", train_sizes_figure(find_train_sizes(moon, "moon", "error", {"window": (0.3, 0.7)}))),
        ("torque", torque_cycle_figure(set_.torques(turns=0.25, samples=500), f"{set_.name}: torque over 1/4 turn")),
        ("moon", moon.motion().plot("moon", turns=0.5)),
    ):
        (IMAGES / f"{name}.svg").write_bytes(render(figure, ".svg"))
        print(f"wrote docs/images/{name}.svg")


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


def commands() -> None:
    """Tooth forms side by side, a motion in time, a sweep of radii, probable tooth counts, a step of assembly,
    a reconstructed train and a train with errors, as the commands draw them.
    """
    command = [sys.executable, "-m", "geartrain"]
    for name, words in (
        ("shapes", "mesh 24 36 --compare"),
        ("run", "dynamics moon-triangular-inertia --rate 1 --turns 0.02"),
        ("radii", "mesh 48 96 --form triangular --friction 0.2 --vary radii=0.8:1.2:81"),
        ("counts", "posterior freeth-2008-doubt --best 1"),
    ):
        plot = ["--force", "--plot", str(IMAGES / f"{name}.svg")]
        subprocess.run([*command, *words.split(), *plot], check=True, stdout=subprocess.DEVNULL)
    with TemporaryDirectory() as folder:
        subprocess.run([*command, "export", "longcase-clock", "--to", f"{folder}/clock"], check=True)
        copyfile(f"{folder}/clock/assembly/07.svg", IMAGES / "assembly.svg")
        (Path(folder) / "metonic.yaml").write_text(file_of("which-counts", "metonic.yaml"), encoding="utf-8")
        found = f"{folder}/found"
        search = [*command, "reconstruct", f"{folder}/metonic.yaml", "--to", found]
        subprocess.run(search, check=True, capture_output=True)
        kind = ["--kind", "graph", "--force", "-o", str(IMAGES / "reconstructed.svg")]
        subprocess.run([*command, "draw", f"{found}/rank-0001.yaml", *kind], check=True, stdout=subprocess.DEVNULL)
        (Path(folder) / "slips.yaml").write_text(file_of("buildability", "slips.yaml"), encoding="utf-8")
        draw = ["draw", f"{folder}/slips.yaml", "--force", "-o", str(IMAGES / "slips.svg")]
        subprocess.run([*command, *draw], check=True, stdout=subprocess.DEVNULL)


def file_of(page: str, name: str) -> str:
    """Return a file that a page contains."""
    text = (IMAGES.parent / f"{page}.md").read_text(encoding="utf-8")
    return text.partition(f"<!-- file: {name} -->\n```yaml\n")[2].partition("```")[0]


def strength() -> None:
    """The safety factors of the parts of a clock."""
    found = geartrain.load("longcase-clock-loaded").strength()
    wheels = {wheel.wheel: {"tooth root": wheel.root_safety} for pair in found.pairs.values() for wheel in pair.wheels}
    parts = wheels | {arbor.link: {"arbor": arbor.safety} for arbor in found.arbors}
    order = sorted(parts, key=lambda part: min(parts[part].values()))
    rows = [Row(part, parts[part], beside=[f"{min(parts[part].values()):.3g}"]) for part in order]
    looks = {"arbor": DOT, "tooth root": {**DOT, "marker": "D", "markerfacecolor": "white", "markeredgecolor": "black"}}
    figure = interval_chart({"safety factor": rows}, looks, title="longcase-clock-loaded: safety factors", log=True)
    (IMAGES / "strength.svg").write_bytes(render(figure, ".svg"))
    print("wrote docs/images/strength.svg")


def sphere() -> None:
    """The gears of the icosidodecahedron, 20 and 12 teeth."""
    found = GearSphere(from_polyhedron("icosidodecahedron", teeth={"5": 20, "3": 12}))
    (IMAGES / "sphere.svg").write_bytes(render(sphere_figure(*found.pose()), ".svg"))
    print("wrote docs/images/sphere.svg")


if __name__ == "__main__":
    main()
