"""What a machine shows and what drives it, surfaces without seams, and nothing beyond the edge of the picture."""

from __future__ import annotations

from fractions import Fraction
from math import asin, atan2, cos, hypot, pi, sin, sqrt, tan

import numpy as np
import pytest
import shipped
from viewing import Opening

ENGINE = """
name: engine
links: {frame: {}, shaft: {}, piston: {}}
revolutes: {A: [frame, shaft]}
slides: {line: [frame, piston]}
couplings: [{id: engine, kind: crank_slider, turns: shaft, slides: piston, radius: 20 mm, rod: 70 mm}]
inputs: {shaft: 1}
outputs: {shaft: {}}
"""
# number of edges of the sectors of each wheel, and number of edges that do not belong to exactly two triangles
EDGES = """() => {
  const {castings: [body, teeth], wheels} = geartrain.stages[0].world;
  return wheels.filter(({wheel}) => !wheel.cone && wheel.kind !== 'worm').map(({own, toothed, wheel}) => {
    const [names, edges] = [new Map(), new Map()];
    for (const [casting, slot] of [[teeth, toothed], ...(wheel.holes.length ? [[body, own]] : [])]) {
      const {geometry: {attributes: {position}}, index} = casting;
      const name = (at) => {
        const key = [0, 1, 2].map((k) => Math.round(position.array[3 * at + k] * 2e3 / wheel.radius)).join();
        return names.get(key) ?? (names.set(key, names.size), names.size - 1);
      };
      for (const part of casting.parts.filter((each) => each.slot === slot)) {
        for (let at = part.from; at < part.to; at += 3) {
          const corners = [0, 1, 2].map((k) => name(index[at + k]));
          if (new Set(corners).size < 3) continue;
          corners.forEach((one, k) => {
            const key = [one, corners[(k + 1) % 3]].sort().join();
            edges.set(key, (edges.get(key) ?? 0) + 1);
          });
        }
      }
    }
    return [edges.size, [...edges.values()].filter((count) => count !== 2).length];
  });
}"""
# points of all parts of a body as [x, y, z] in space, for a colour of `world.parts`, at a number of turns
POINTS = """([body, keep, turns]) => {
  geartrain.setTurns(turns);
  const {world, camera} = geartrain.stages[0], {castings, nodes, parts} = world;
  world.turn();
  camera.updateMatrixWorld();
  const Vector = camera.position.constructor, own = new Function('part', `return ${keep}`);
  const slots = new Set(parts.filter(own).map(({slot}) => slot));
  return castings.filter(({geometry}) => geometry).flatMap(({geometry, parts}) => {
    const points = geometry.attributes.position.array;
    const isOwn = (part) => (body === null || part.body === body) && (!keep || slots.has(part.slot));
    return parts.filter(isOwn).map((part) => {
      const found = [];
      for (let at = part.first; at < part.last; at += 1) {
        const point = new Vector(...points.slice(3 * at, 3 * at + 3)).applyMatrix4(nodes[part.body].matrixWorld);
        found.push(body === null ? point.project(camera).toArray() : point.toArray());
      }
      return found;
    });
  });
}"""


@pytest.mark.parametrize("name", ["planetary-24-18-60", "crossed-helical", "cycloidal-reducer", "longcase-clock"])
def test_the_sectors_of_a_wheel_are_a_closed_surface_without_seams(show: Opening, name: str) -> None:
    for edges, open_edges in show(name, teeth=True).run(EDGES):
        assert edges > 100
        assert open_edges == 0


def test_beads_are_on_their_rings_at_the_angles_of_their_pointers(show: Opening) -> None:
    shown, name = show("huygens-planetarium-1682"), "huygens-planetarium-1682"
    scene, solved = shipped.built(name), shipped.train(name).solve()
    radii = []
    for turns in (Fraction(0), Fraction(3, 7)):
        for pointer in (each for each in scene.pointers if each.hand == "bead"):
            assert pointer.dial is not None
            dial = scene.dials[pointer.dial]
            parts = shown.run(POINTS, [pointer.body, "part.dial !== undefined && !part.plate", str(turns)])
            # of arm, sphere and ring, the sphere is that whose extents are equal
            sphere = min(parts, key=lambda each: max(np.ptp(each, axis=0)) / min(np.ptp(each, axis=0)))
            middle = (np.max(sphere, axis=0) + np.min(sphere, axis=0)) / 2 - dial.centre
            up, right = middle @ dial.zero, middle @ np.cross(dial.zero, dial.normal)
            # seen along +z, a positive turn is counter-clockwise
            expected = -2 * pi * float(Fraction(solved[pointer.output]) * turns) * np.sign(dial.normal[2])
            off = (atan2(right, up) - expected) / (2 * pi)
            assert abs(off - round(off)) < 2e-3, pointer.output
            radii.append(hypot(right, up))
    count = len(radii) // 2
    assert count == 6
    assert np.allclose(radii[:count], radii[count:], rtol=2e-3)
    assert np.allclose(np.diff(radii[:count]), radii[1] - radii[0], rtol=2e-2)


def test_the_ring_of_the_ecliptic_is_its_stereographic_projection(show: Opening) -> None:
    """A point of ecliptic longitude L has the declination asin(sin e sin L); distances from the pole are tan(p/2)."""
    shown, scene = show("prague-orloj"), shipped.built("prague-orloj")
    pointer = next(each for each in scene.pointers if each.hand == "ecliptic")
    assert pointer.dial is not None
    dial = scene.dials[pointer.dial]
    parts = shown.run(POINTS, [pointer.body, "part.dial !== undefined && !part.plate", "0"])
    edges = []
    for part in parts:
        off = np.array(part) - dial.centre
        edges.append(np.column_stack([off @ np.cross(dial.zero, dial.normal), off @ np.array(dial.zero)]))
    ring = max(edges, key=lambda each: np.min(np.hypot(*(each - each.mean(axis=0)).T)))  # an open middle
    middle = (ring.max(axis=0) + ring.min(axis=0)) / 2
    radius = np.hypot(*(ring - middle).T).max()
    obliquity, scale = 23.44 * pi / 180, 0.0
    for degrees in range(0, 360, 30):
        longitude = degrees * pi / 180
        declination = asin(sin(obliquity) * sin(longitude))
        ascension = atan2(cos(obliquity) * sin(longitude), cos(longitude))
        far = tan((pi / 2 + declination) / 2)
        scale = scale or sqrt(radius**2 - middle @ middle)  # at the equinoxes, far is 1
        point = scale * far * np.array([-sin(ascension), cos(ascension)])  # counted counter-clockwise
        assert hypot(*(point - middle)) == pytest.approx(radius, rel=2e-3), degrees


@pytest.mark.parametrize("turns", [Fraction(0), Fraction(1, 6), Fraction(1, 2), Fraction(4, 5)])
def test_the_rod_of_a_crank_slider_joins_its_pins(show: Opening, turns: Fraction) -> None:
    shown = show(text=ENGINE)
    (rod,) = shown.run(POINTS, [shown.run("geartrain.stages[0].world.poses.hanger(0)"), "", str(turns)])
    angle = 2 * pi * float(turns)
    pin = 20 * cos(angle), 20 * sin(angle)
    block = 20 * cos(angle) + sqrt(70**2 - (20 * sin(angle)) ** 2)
    x, y = np.array(rod)[:, 0], np.array(rod)[:, 1]
    along = ((x - pin[0]) * (block - pin[0]) - (y - pin[1]) * pin[1]) / 70
    assert along.min() == pytest.approx(0, abs=1e-3)
    assert along.max() == pytest.approx(70, abs=1e-3)


@pytest.mark.parametrize(
    "name",
    ["longcase-clock", "longcase-clock-weight", "prague-orloj", "south-pointing-chariot", "lathe-back-gear"],
)
def test_nothing_is_cropped_at_the_start(show: Opening, name: str) -> None:
    shown = show(name, teeth=True, viewport={"width": 1280, "height": 800})
    points = np.concatenate(shown.run(POINTS, [None, "", "0"]))
    assert np.abs(points[:, :2]).max() <= 1
    assert np.ptp(points[:, :2], axis=0).max() > 1.4, "it fills the picture"
