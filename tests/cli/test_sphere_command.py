"""`geartrain sphere`: printed numbers, trains that load again, pictures whose teeth meet, kind refusals."""

from __future__ import annotations

import json
from math import atan, degrees, sqrt
from pathlib import Path

import numpy as np
import pytest
from commands import call

from geartrain import GearTrainError, load
from geartrain.spherical import GearSphere, from_polyhedron


def data(*arguments: object) -> dict:
    return json.loads(call("sphere", *arguments, "--json").stdout)


def test_the_set_of_the_document_has_its_printed_numbers() -> None:
    found = data("icosidodecahedron", "--teeth", "5=20,3=12", "--radius", "5=1.25")
    assert (found["gears"], found["meshes"], found["mobility"], found["gridlock"]) == (32, 60, 1, None)
    assert (found["closes"], found["residue"], found["rule"]) == (True, 0, "3 divides z3 and 5 divides z5")
    assert found["sphere_radius"] == pytest.approx(3.13198541004301, rel=1e-14)
    assert found["radii"] == pytest.approx({"5": 1.25, "3": 0.75}, rel=1e-13)
    assert found["cones"] == pytest.approx({"5": 23.522418447732, "3": 13.854949692918}, abs=1e-12)
    assert found["angles"]["5-3"] == pytest.approx(degrees(atan(3 - sqrt(5))), abs=1e-13)


def test_sets_that_do_not_close_or_turn_have_exit_code_1() -> None:
    done = call("sphere", "icosidodecahedron", "--teeth", "5=12,3=6", "--json")
    missed = json.loads(done.stdout)
    assert (done.exit_code, missed["closes"]) == (1, False)
    assert missed["residue"] == pytest.approx(0.4, abs=1e-12)
    locked = data("truncated icosahedron")
    assert (locked["mobility"], locked["closes"], len(locked["gridlock"]["release"]["meshes"])) == (0, None, 30)


def test_a_set_becomes_a_train_that_turns_as_it_should(tmp_path: Path) -> None:
    path = tmp_path / "sphere.yaml"
    assert call("sphere", "rhombicosidodecahedron", "--teeth", "5=25,4=14,3=12", "-o", path).exit_code == 0
    train = load(str(path))
    assert (train.mobility.by_rank, train.mobility.redundant) == (1, 120 - 62 + 1)
    # the declared train knows of its loops what the set knew
    assert train.closure.kind == "closes"


def test_a_picture_has_the_teeth_of_every_mesh_in_the_gaps() -> None:
    configuration, cones, phases = GearSphere(from_polyhedron("cuboctahedron", teeth={"4": 18, "3": 12})).pose()
    for i, j in configuration.meshes:
        z = [configuration.teeth[configuration.kinds[gear]] for gear in (i, j)]
        towards = [configuration.azimuth(i, j), configuration.azimuth(j, i)]
        # teeth past the pitch point, counterclockwise on both: a tooth on one side, a gap on the other
        past = [count * angle / (2 * np.pi) - phases[g] for count, angle, g in zip(z, towards, (i, j), strict=True)]
        assert abs((sum(past) - 0.5 + 0.5) % 1 - 0.5) < 1e-9 or abs((sum(past) + 0.5) % 1) < 1e-9
        assert cones[i] + cones[j] == pytest.approx(configuration.angle(i, j), abs=1e-12)


def test_suggestions_are_the_best_of_the_table() -> None:
    found = data("rhombicosidodecahedron", "--suggest", 40, "--best", 3)
    assert found["solutions"][0]["teeth"] == {"5": 40, "4": 34, "3": 15}
    none = call("sphere", "rhombicosidodecahedron", "--suggest", 8)
    assert (none.exit_code, "rejected" in none.stdout) == (1, True)


def test_a_user_s_own_solid_and_graph(tmp_path: Path) -> None:
    cube = tmp_path / "cube.txt"
    kinks = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    cube.write_text("# a cube\n" + "".join(f"{x}, {y}, {z}\n" for x, y, z in kinks), encoding="utf-8")
    found = data(cube, "--gears", "faces+vertices", "--teeth", "4=16,v=12")
    assert (found["gears"], found["meshes"], found["mobility"]) == (14, 24, 1)
    cube.write_text("1 0 0\n0 1\n0 0 one\n", encoding="utf-8")
    with pytest.raises(GearTrainError, match=r"cube.txt:2.*(\n.*)*cube.txt:3"):
        raise call("sphere", cube).exception or AssertionError
    graph = tmp_path / "cube-graph.txt"
    graph.write_text("a b\nb c\nc d\nd a\ne f\nf g\ng h\nh e\na e\nb f\nc g\nd h\n", encoding="utf-8")
    packed = data("--graph", graph)
    assert (packed["gears"], packed["meshes"], packed["mobility"]) == (8, 12, 1)
    assert set(packed["angles"].values())


def test_the_picture_and_the_survey(tmp_path: Path) -> None:
    picture = tmp_path / "s.svg"
    assert call("sphere", "octahedron", "--teeth", 16, "--plot", picture).exit_code == 0
    assert "16 teeth" in picture.read_text(encoding="utf-8")
    refused = call("sphere", "octahedron", "--plot", picture)
    assert isinstance(refused.exception, GearTrainError)
    table = call("sphere", "--survey").stdout
    assert "\ntruncated icosahedron " in table
    assert "41.810314896" in table
