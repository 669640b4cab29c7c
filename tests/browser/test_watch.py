"""`geartrain watch`: the page follows the file, keeps camera and crank, and is served only on this machine."""

from __future__ import annotations

import os
import re
import signal
import socket
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest
from clusters import PATIENCE, next_line
from conftest import OpenWindow
from playwright.sync_api import Page
from viewing import listen

pytest.importorskip("tornado", reason="the extra 'watch' is not installed")
pytest.importorskip("watchdog", reason="the extra 'watch' is not installed")

TRAIN = """
links:
  frame: {wheels: {r: {teeth: 60, internal: true}}}
  sun: {wheels: {s: 24}}
  planet: {wheels: {p: 18}}
  carrier: {}
revolutes: {main: [frame, sun, carrier], P: [carrier, planet]}
gears: [s ~ p, p ~ r]
inputs: {sun: 1}
outputs: {carrier: {}}
"""


@pytest.fixture
def parent(tmp_path: Path) -> Path:
    (tmp_path / "elsewhere").mkdir()
    path = tmp_path / "elsewhere" / "parent.yaml"
    path.write_text(TRAIN, encoding="utf-8")
    return path


@pytest.fixture
def file(tmp_path: Path, parent: Path) -> Path:
    path = tmp_path / "train.yaml"
    path.write_text(f"extends: {parent.relative_to(tmp_path)}\ntitle: First\n", encoding="utf-8")
    return path


@pytest.fixture
def served(file: Path) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    command = [sys.executable, "-m", "geartrain", "watch", str(file)]
    environment = {**os.environ, "COLUMNS": "200"}
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=environment) as running:
        try:
            address = re.search(r"http://127\.0\.0\.1:\d+/", next_line(running.stderr))
            yield address[0], running
            running.send_signal(signal.SIGINT)
            running.communicate(timeout=PATIENCE)
            assert running.returncode == 0
        finally:
            running.kill()  # without end, it would serve forever


def follow(page: Page, version: int) -> None:
    page.locator(f"body[data-version='{version}']").wait_for(state="attached", timeout=60_000)


def test_the_page_follows_the_file_and_keeps_crank_and_camera(
    open_window: OpenWindow, served: tuple[str, subprocess.Popen[str]], file: Path, parent: Path
) -> None:
    page = open_window(viewport={"width": 1200, "height": 700})
    wrong = listen(page, served[0], served[0].replace("http", "ws"), "data:", "blob:", "about:")
    page.goto(served[0])
    follow(page, 1)
    report, view = page.frame_locator("#report"), page.frames[2]
    assert report.get_by_text("2/7").count()
    view.evaluate("geartrain.setTurns('7/3')")
    view.evaluate("geartrain.stages[0].camera.position.set(10, 20, 300)")
    # a parent in another folder
    parent.write_text(TRAIN.replace("60", "66").replace("18", "21"), encoding="utf-8")
    follow(page, 2)
    view = page.frames[2]
    assert report.get_by_text("4/15").count(), "24 / (24 + 66)"
    assert view.evaluate("[geartrain.turns, geartrain.scenes[0].wheels[0].teeth]") == ["7/3", 66]
    at = view.evaluate("geartrain.stages[0].camera.position.toArray()")
    assert at == pytest.approx([10, 20, 300], rel=1e-6)
    # the error is shown above the last valid train, and disappears after the correction
    file.write_text(file.read_text(encoding="utf-8") + "gesrs: []\n", encoding="utf-8")
    told = page.locator("#told")
    told.wait_for(state="visible")
    assert "did you mean 'gears'" in told.inner_text()
    assert report.get_by_text("4/15").count()
    file.write_text("extends: elsewhere/parent.yaml\ntitle: Second\n", encoding="utf-8")
    told.wait_for(state="hidden")
    report.get_by_text("Second").first.wait_for()
    assert not wrong


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost"])
def test_the_outer_page_runs_its_own_script_and_reaches_its_own_server_only(
    open_window: OpenWindow, served: tuple[str, subprocess.Popen[str]], host: str
) -> None:
    page = open_window()
    broken: list[str] = []
    page.on("console", lambda message: broken.append(message.text) if message.type == "error" else None)
    answer = page.goto(served[0].replace("127.0.0.1", host))
    assert "default-src 'none'" in answer.headers["content-security-policy"]
    follow(page, 1)
    assert not broken, "nothing that the page needs is forbidden"
    page.evaluate("document.body.append(Object.assign(document.createElement('script'), {text: 'window.ran = true'}))")
    page.evaluate("document.body.insertAdjacentHTML('beforeend', '<img src=/report onerror=window.ran=true>')")
    assert page.evaluate("fetch('/report').then(() => true, () => false)") is False
    assert page.evaluate(
        "new Promise(done => { const line = new WebSocket('ws://127.0.0.1:9'); line.onerror = () => done(true) })"
    )
    assert page.evaluate("window.ran") is None
    assert len([each for each in broken if "Content Security Policy" in each]) >= 3


def test_it_answers_this_machine_alone(served: tuple[str, subprocess.Popen[str]]) -> None:
    port = int(served[0].rstrip("/").rpartition(":")[2])
    with urllib.request.urlopen(served[0]) as answer:
        assert answer.status == 200
    named = urllib.request.Request(served[0], headers={"Host": "example.org"})
    with pytest.raises(urllib.error.HTTPError, match="404") as refused:
        urllib.request.urlopen(named)
    refused.value.close()
    own = {each[4][0] for each in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)}
    for address in own - {"127.0.0.1", "127.0.1.1"}:
        with pytest.raises(OSError, match="refused"):
            socket.create_connection((str(address), port), timeout=2)
    taken = subprocess.run(
        [sys.executable, "-m", "geartrain", "watch", str(Path(__file__).parent / "none.yaml")],
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE,
    )
    assert taken.returncode == 2
    assert "does not exist" in taken.stderr
