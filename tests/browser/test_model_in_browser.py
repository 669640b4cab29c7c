"""GLB file in a browser, read by the loader of three.js: position of every part, at rest and in motion."""

from __future__ import annotations

import base64
import shutil
import subprocess
from math import cos, sin
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
import shipped

from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.workshop import train_file
from geartrain.workshop.export.triangle_files import Keyframes

if TYPE_CHECKING:
    from conftest import OpenPage
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

VIEWER = Path(__file__).parent.parent.parent / "geartrain" / "viewer"
STEPS = 65534  # along the largest extent of a part

SCRIPT = """
import { AmbientLight, AnimationMixer, Box3, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

globalThis.show = async (text) => {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const { scene, animations } = await new GLTFLoader().parseAsync(bytes.buffer, "");
  const mixer = new AnimationMixer(scene);
  for (const each of animations) mixer.clipAction(each).play();
  const world = new Scene().add(new AmbientLight(0xffffff, 3), scene);
  const box = new Box3().setFromObject(scene);
  const camera = new PerspectiveCamera(40, 1, 0.001, 10);
  const { min: low, max: high } = box;
  camera.position.set((low.x + high.x) / 2, (low.y + high.y) / 2, high.z + 1.2 * (high.y - low.y));
  const renderer = new WebGLRenderer({ preserveDrawingBuffer: true });
  renderer.setSize(200, 200);
  document.body.append(renderer.domElement);
  globalThis.places = (seconds) => {
    mixer.setTime(seconds);
    scene.updateMatrixWorld(true);
    const found = {};
    scene.traverse((node) => {
      if (!node.isMesh) return;
      const { min, max } = new Box3().setFromObject(node, true);
      found[node.userData.name || node.name] = [min.toArray(), max.toArray()];
    });
    return found;
  };
  globalThis.painted = () => {
    renderer.render(world, camera);
    const gl = renderer.getContext();
    const pixels = new Uint8Array(4 * 200 * 200);
    gl.readPixels(0, 0, 200, 200, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return pixels.filter((value, at) => at % 4 < 3 && value > 30).length / pixels.length;
  };
  return animations.map((each) => each.duration);
};
globalThis.geartrain = { ready: true };
"""


@pytest.fixture(scope="module")
def loader(program: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Page with three.js and its glTF loader, in the version with which the viewer is built."""
    npm, node = shutil.which("npm"), shutil.which("node")
    if npm is None or node is None:
        pytest.skip("node and npm are not there: no GLB is loaded by three.js")
    folder = tmp_path_factory.mktemp("loader")
    for name in ("package.json", "package-lock.json"):
        shutil.copy(VIEWER / name, folder)
    got = subprocess.run([npm, "ci", "--prefer-offline"], cwd=folder, capture_output=True, text=True, check=False)
    if got.returncode != 0:
        pytest.skip(f"npm cannot get its packages: no GLB is loaded by three.js: {got.stderr}")
    (folder / "model.js").write_text(SCRIPT, encoding="utf-8")
    bundle = ["node_modules/.bin/esbuild", "model.js", "--bundle", "--format=iife", "--outfile=bundle.js"]
    subprocess.run(bundle, cwd=folder, check=True, capture_output=True)
    (folder / "page.html").write_text(
        '<!doctype html><meta charset="utf-8"><body><script src="bundle.js"></script>', encoding="utf-8"
    )
    return folder / "page.html"


def boxes(work: SolidModel, share: float) -> dict[str, tuple[Floats, Floats]]:
    """Return the bounding box of every part [m] after a fraction of the animation, from composed poses."""
    turning, bodies = Keyframes.of(work), work.scene.bodies
    count = 1000

    def placed(at: int, points: Floats) -> Floats:
        body = bodies[at]
        if body.parent is None:
            return points
        angle = turning.angle(at, count)[round(share * count)] if turning.keys(at) else 0.0
        about = np.array(body.point)
        return placed(body.parent, turned(points - about, np.array(body.direction), float(angle)) + about)

    def turned(points: Floats, axis: Floats, angle: float) -> Floats:
        """Return points rotated about an axis (Rodrigues' formula)."""
        along = np.outer(points @ axis, axis)
        return along + cos(angle) * (points - along) + sin(angle) * np.cross(axis, points)

    found = {}
    for part in work.parts:
        points = placed(part.body, part.placed.vertices) / 1000
        found[part.name] = points.min(axis=0), points.max(axis=0)
    return found


@pytest.mark.parametrize("name", ["three-planets", "bevel-differential"])
def test_three_js_shows_every_part_at_its_place_at_rest_and_in_motion(
    loader: Path, open_page: OpenPage, name: str
) -> None:
    work = SolidModel(shipped.train(name), ManufacturingSizes())
    shown = open_page(loader)
    data = base64.b64encode(train_file(work, "glb")).decode("ascii")
    (seconds,) = shown.run("(data) => show(data)", data)
    turning = Keyframes.of(work)
    assert seconds == pytest.approx(turning.seconds, rel=1e-6)
    for share in (0.0, 0.137, 0.5):
        places = shown.run("(time) => places(time)", share * seconds)
        expected = boxes(work, share)
        assert len(places) == len(expected)
        for part, (low, high) in expected.items():
            step = (high - low).max() / STEPS
            found = places[part]
            assert np.abs(np.array(found) - (low, high)).max() < step + 1e-6, (part, share)
    assert shown.run("painted()") > 0.05
    assert not shown.errors
    assert not [each for each in shown.requests if "bundle.js" not in each]
