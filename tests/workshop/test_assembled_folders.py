"""Exported folders, read by programs that know nothing of geartrain: trimesh, manifold3d, svgelements, shapely."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest
import trimesh
from commands import call
from sampling import first_few
from shipped import train
from studies.assembled_folder import AssembledPart, MeasuredFit, find_fits, find_overlaps, read_parts

from geartrain.scene import ManufacturingSizes, SolidModel

TRAINS = ("watch-going-train", "planetary-24-18-60")
CHORD = 0.005  # mm: corners of a round hole are outside its circle
SHARE = 1e-6  # of a part: a larger common volume is no touch


@cache
def folder(name: str, *options: str) -> Path:
    to = Path(mkdtemp()) / name
    done = call("export", name, "--to", to, "--as", "svg,stl,glb", *options)
    assert done.exit_code == ("not ready to cut" in done.output), done.output
    return to


@cache
def parts(name: str) -> list[AssembledPart]:
    return read_parts(folder(name))


@cache
def fits(name: str) -> list[MeasuredFit]:
    return find_fits(parts(name))


def stated(name: str) -> tuple[str, float, float]:
    """The README, the running clearance and that of what is joined (mm)."""
    text = (folder(name) / "README.md").read_text(encoding="utf-8")
    running = re.search(r"Bearing holes are (\S+) mm wider", text)
    joined = re.search(r"\(hole ([+-]\S+) mm\)", text)
    assert running is not None
    assert joined is not None
    return text, float(running[1]), float(joined[1])


# ---------------------------------------------------------------------------------------------------------- volumes


@pytest.mark.parametrize("name", TRAINS)
def test_every_part_is_closed_and_no_two_stand_in_each_other(name: str) -> None:
    assert all(part.mesh.is_watertight and part.mesh.volume > 0 for part in parts(name))
    assert [each for each in find_overlaps(parts(name)) if each.share > SHARE] == []


@pytest.mark.parametrize("name", ["humpage", "worm"])
def test_wheels_whose_teeth_lie_in_no_plane_are_closed_and_stand_on_their_arbors(name: str) -> None:
    """Coincident vertices were doubled, with triangles of area 0 between them; a worm had no bore."""
    assert all(part.mesh.is_watertight and part.mesh.volume > 0 for part in parts(name))
    pairs = {frozenset((each.one, each.other)): each.share for each in find_overlaps(parts(name))}
    rods = [part.name for part in parts(name) if part.name.endswith(("arbor", "pipe"))]
    assert rods
    assert max((share for pair, share in pairs.items() if pair & {*rods}), default=0.0) < 0.01, "but for chords"


def test_a_bracket_goes_through_its_plate_in_a_mortise() -> None:
    """The bracket is next to a wheel that passes through the same plate; they overlapped by 59 cubic mm."""
    whole = {part.name: part.mesh.bounds for part in parts("worm") if part.name.endswith("plate")}
    normal = int(np.argmin(np.ptp(next(iter(whole.values())), axis=0)))
    plates = {name: bounds[:, normal] for name, bounds in whole.items()}
    brackets = [part.mesh.bounds[:, normal] for part in parts("worm") if "bracket" in part.name]
    for low, high in brackets:
        assert sum(faces[0] >= low - 1e-4 and faces[1] <= high + 1e-4 for faces in plates.values()) == 1
    assert len(brackets) == 2
    assert [each for each in find_overlaps(parts("worm")) if plates.keys() & {each.one, each.other}] == []


def test_pillars_brackets_and_posts_of_cages_stand_in_nothing_but_their_eyes() -> None:
    """A pillar overlapped a bracket, and a post of a cage its arm; only the saddle of its eye is filed to the post."""
    found = [each for each in find_overlaps(parts("south-pointing-chariot")) if each.share > SHARE]
    kinds = {"plate", "pillar", "bracket", "arm", "post"}
    held = {frozenset((each.one, each.other)) for each in found if kinds & {*f"{each.one} {each.other}".split()}}
    told = frozenset(("spider cage post", "lo30"))  # the export says that the post is in the way of this wheel
    assert held == {frozenset(("spider cage post", "spider eye")), told}


def test_two_parts_that_are_pushed_into_each_other_are_seen() -> None:
    """A hundredth of a millimetre of an arbor's radius in the plate that bears it."""
    arbor = next(part for part in parts("watch-going-train") if part.name == "third arbor")
    pushed = arbor.mesh.copy()
    pushed.apply_translation((0.05, 0.0, 0.0))
    others = [part for part in parts("watch-going-train") if part is not arbor]
    found = find_overlaps([*others, AssembledPart(arbor.name, arbor.body, pushed)])
    assert {each.one for each in found if each.share > SHARE} >= {"plate back plate", "plate front plate"}


@pytest.mark.parametrize("name", TRAINS)
def test_the_stl_holds_the_parts_that_the_glb_names(name: str) -> None:
    """The parts are in the same order, and their bounding boxes are those of the solids."""
    whole = trimesh.load(folder(name) / "assembly.stl")
    assert whole.volume == pytest.approx(sum(part.mesh.volume for part in parts(name)), rel=1e-6)
    assert len(whole.split(only_watertight=True)) >= len(parts(name))
    work = SolidModel(train(name), ManufacturingSizes())
    assert len(work.parts) == len(parts(name))
    for part, read in zip(work.parts, parts(name), strict=True):
        assert (read.name, read.body) == (part.name, work.scene.bodies[part.body].id)
        ends = part.placed.vertices.min(axis=0), part.placed.vertices.max(axis=0)
        assert read.mesh.bounds == pytest.approx(np.array(ends), abs=1e-4)


# ------------------------------------------------------------------------------------------------------------- fits


@pytest.mark.parametrize("name", first_few(1, ["planetary-24-18-60", "longcase-clock-cycloidal"]))
def test_pipes_run_on_what_they_are_on_with_the_stated_clearance(name: str) -> None:
    _, running, _ = stated(name)
    pipes = {part.name for part in parts(name) if part.name.endswith("pipe")}
    inside = {fit.hole_of: fit for fit in fits(name) if fit.hole_of in pipes}
    assert pipes
    assert set(inside) == pipes
    for fit in inside.values():
        assert fit.clearance == pytest.approx(running, abs=CHORD)
        assert fit.aside < 1e-5


@pytest.mark.parametrize("name", TRAINS)
def test_what_is_joined_has_the_hole_that_is_stated_and_all_else_turns_freely(name: str) -> None:
    text, running, joint = stated(name)
    for fit in fits(name):
        if fit.joined:
            assert joint - 1e-4 <= fit.clearance <= joint + CHORD, fit
        else:
            assert fit.clearance >= running - 1e-4, fit
    for diameter in re.findall(r"\(pivot (\S+?)\)", text):
        assert any(fit.rod == pytest.approx(float(diameter), abs=1e-4) for fit in fits(name))
    wheels = {part.name for part in parts(name)} & {path.stem for path in (folder(name) / "wheels").glob("*.stl")}
    held = {fit.hole_of for fit in fits(name)} | {fit.rod_of for fit in fits(name)}
    assert wheels <= held, "no wheel hangs in the air"
