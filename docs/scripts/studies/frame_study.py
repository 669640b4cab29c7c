"""What a picture of the viewer costs: its frames against those of three.js's own instanced example, in one run."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from stills import open_browser, visit

import geartrain
from geartrain.scene import build_scene
from geartrain.viewer import page
from studies.measurement import Rounds, in_turns
from studies.records import StudyRecords

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

HERE = Path(__file__).resolve().parent
VIEWER = Path(geartrain.__file__).parent / "viewer"
SIZE = {"width": 1000, "height": 620}
ROUNDS, WARM = 15, 3

# one frame of the viewer, with all that a turn of the crank asks of it, and its end waited for
FRAME = """((turn) => {
  const [stage] = globalThis["geartrain"].stages;
  stage.setTurns(turn);
  stage.render();
  const context = stage.renderer.getContext();
  context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4));
})"""
INSTANCED = "((turn) => instanced.frame(turn / 50))"
# triangles of one frame as three.js counts them; those of parts that are cut open are drawn twice, from both sides
TRIANGLES = """(([stage]) => {
  stage.render();
  return stage.renderer.info.render.triangles;
})(globalThis["geartrain"].stages)"""
CANVAS = """(({ clientWidth: width, clientHeight: height }) => [width, height])(
  globalThis["geartrain"].stages[0].canvas)"""


@dataclass(frozen=True)
class FrameRecord:
    """Frames of a page of a train (ms) and of the instanced example, and how many times as long; the page's weight.

    room_ratio   over the example whose metal mirrors a room, as the viewer's does; else it has lamps only
    """

    train: str
    triangles: int
    example_triangles: int
    canvas: list[int]
    milliseconds: float
    example_milliseconds: float
    ratio: float
    room_ratio: float
    kilobytes: float
    requests: int


@dataclass(frozen=True)
class FrameRecords(StudyRecords):
    """All trains."""

    frames: list[FrameRecord]


def frames(*names: str) -> FrameRecords:
    """Of shipped trains."""
    with open_browser() as browser:
        return FrameRecords("Frames", [measured(browser, name) for name in names])


def measured(browser: Browser, name: str, rounds: int = ROUNDS) -> FrameRecord:
    """A page of a train and the example, each drawn once a round."""
    with (
        TemporaryDirectory() as folder,
        shown(browser) as (sheet, requested),
        shown(browser) as (other, _),
        shown(browser) as (roomy, _),
    ):
        path = Path(folder) / "page.html"
        path.write_text(page([build_scene(geartrain.load(name), formulas=True)]), encoding="utf-8")
        visit(sheet, path.as_uri(), "Boolean(globalThis.geartrain?.ready)")
        triangles, canvas = sheet.evaluate(TRIANGLES), sheet.evaluate(CANVAS)
        example = Path(folder) / "instanced.html"
        example.write_text(_example(*canvas), encoding="utf-8")
        for each, way in ((other, ""), (roomy, ",room")):
            visit(each, f"{example.as_uri()}#{triangles}{way}", "Boolean(globalThis.instanced)")
        turns = count(1)
        tasks = (
            partial(_frame, sheet, FRAME, turns),
            partial(_frame, other, INSTANCED, turns),
            partial(_frame, roomy, INSTANCED, turns),
        )
        in_turns(tasks, WARM)
        own, base, mirrored = (Rounds(each.seconds, None) for each in in_turns(tasks, rounds))
        return FrameRecord(
            name,
            int(triangles),
            int(other.evaluate("instanced.triangles")),
            canvas,
            1e3 * own.median,
            1e3 * base.median,
            own.over(base),
            own.over(mirrored),
            path.stat().st_size / 1e3,
            len([each for each in requested if each != path.as_uri()]),
        )


def _frame(sheet: Page, script: str, turns: Iterator[int]) -> None:
    sheet.evaluate(script, next(turns))


@contextmanager
def shown(browser: Browser) -> Iterator[tuple[Page, list[str]]]:
    """A window, and the addresses that it asks for."""
    # a page in motion would be drawn between the frames that are measured
    sheet = browser.new_page(viewport=SIZE, reduced_motion="reduce")  # type: ignore[arg-type]
    requested: list[str] = []
    sheet.on("request", lambda request: requested.append(request.url.partition("#")[0]))
    yield sheet, requested
    sheet.close()


def _example(width: int, height: int) -> str:
    """The page of the example, its program bundled by what bundles the viewer's."""
    source = (HERE / "instanced.js").read_text(encoding="utf-8")
    bundle = [str(VIEWER / "node_modules/.bin/esbuild"), "--bundle", "--minify", "--format=iife"]
    program = subprocess.run(bundle, input=source, cwd=VIEWER, capture_output=True, text=True, check=True).stdout
    program = program.replace("</script", "<\\/script")
    canvas = f'<canvas style="width:{width}px;height:{height}px"></canvas>'
    return f"<!doctype html><meta charset=utf-8>{canvas}<script>{program}</script>"
