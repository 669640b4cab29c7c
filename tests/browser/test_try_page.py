"""Page for trying the package: served like the site, without a network."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect
from viewing import listen

START = 120_000  # ms: Python on a busy machine
PLANETARY = "#train=planetary-24-18-60"


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_: Any) -> None:
        pass


@pytest.fixture(scope="module")
def address(site: Path) -> Iterator[str]:
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(_Quiet, directory=str(site)))
    Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="module")
def context(browser: Browser) -> Iterator[BrowserContext]:
    context = browser.new_context(viewport={"width": 1300, "height": 900})
    yield context
    context.close()


@pytest.fixture(scope="module")
def opened(context: BrowserContext, address: str) -> Iterator[tuple[Page, list[str]]]:
    """Page on which Python has started, without a network from then on, and a list of its errors."""
    page = context.new_page()
    wrong = listen(page, address, "about:", "blob:")
    page.on("request", lambda requested: wrong.append(requested.method) if requested.method != "GET" else None)
    page.goto(address + "try.html" + PLANETARY)
    expect(page.locator("#try .progress")).to_be_visible()
    expect(page.locator("#try .verdict.good")).to_be_visible(timeout=START)
    context.set_offline(True)
    yield page, wrong
    context.set_offline(False)
    page.close()


@pytest.fixture
def sheet(opened: tuple[Page, list[str]]) -> Page:
    return opened[0]


def text_of(page: Page) -> str:
    return "\n".join(page.locator("#try .cm-line").all_inner_texts())


def replace(page: Page, old: str, new: str) -> None:
    """Select a part of a line and type over it."""
    line = page.locator("#try .cm-line", has_text=old).first
    line.click()
    page.keyboard.press("Home")
    text = line.inner_text()
    for _ in range(text.index(old) - (len(text) - len(text.lstrip()))):
        page.keyboard.press("ArrowRight")
    for _ in old:
        page.keyboard.press("Shift+ArrowRight")
    page.keyboard.insert_text(new)


def dial(page: Page, name: str) -> str:
    return page.locator("#try .dial", has=page.locator(f"b:text-is('{name}')")).locator("code").inner_text()


def test_it_answers_exactly_and_asks_nobody(opened: tuple[Page, list[str]]) -> None:
    sheet, wrong = opened
    assert sheet.locator("#try .verdict").inner_text() == "determined: every speed follows from sun"
    assert dial(sheet, "carrier") == "2/7", "24 / (24 + 60)"
    report = sheet.frame_locator("#try .page iframe")
    expect(report.locator("h2", has_text="Adjacency matrix").first).to_be_visible()
    expect(report.locator("h2", has_text="Fundamental circuits")).to_be_visible()
    assert wrong == []


def test_without_a_network_it_answers_what_is_typed(sheet: Page) -> None:
    replace(sheet, "{s: 24}", "{s: 30}")
    replace(sheet, "{p: 18}", "{p: 15}")
    expect(sheet.locator("#try .dial code").first).to_have_text("1/3")  # 30 / (30 + 60)
    expect(sheet.locator("#try .problems .error").first).to_contain_text("2/7")
    replace(sheet, "{s: 30}", "{s: 24}")
    replace(sheet, "{p: 15}", "{p: 18}")
    expect(sheet.locator("#try .verdict.good")).to_be_visible()


def test_an_error_stands_under_its_line_with_its_cure(sheet: Page) -> None:
    number = text_of(sheet).splitlines().index("inputs: {sun: 1}") + 1
    replace(sheet, "inputs", "input")
    error = sheet.locator("#try .problems .error", has_text=f"line {number}:")
    expect(error).to_contain_text("did you mean 'inputs'?")
    expect(sheet.locator("#try .cm-lint-marker-error")).to_be_visible()
    expect(sheet.locator("#try .cm-lintRange-error")).to_have_text("input: {sun: 1}")
    replace(sheet, "input", "inputs")
    expect(sheet.locator("#try .cm-lint-marker-error")).to_have_count(0)


def test_it_completes_keys_by_their_place_and_names_of_the_train(sheet: Page) -> None:
    last = sheet.locator("#try .cm-line").last
    chooser = sheet.locator("#try .example")

    def offered(*typed: str) -> list[str]:
        last.click()
        sheet.keyboard.press("Control+End")
        for each in typed[:-1]:
            sheet.keyboard.insert_text(each)
            sheet.keyboard.press("Enter")
        sheet.keyboard.insert_text(typed[-1])
        sheet.keyboard.press("Control+Space")
        options = sheet.locator("#try .cm-tooltip-autocomplete li")
        options.first.wait_for()
        found = options.all_inner_texts()
        sheet.keyboard.press("Escape")
        chooser.select_option("worm")
        chooser.select_option("planetary-24-18-60")
        expect(sheet.locator("#try .verdict.good")).to_be_visible()
        return found

    assert "couplings" in offered("coup")
    assert {"carrier", "planet"} <= set(offered("fixed: ["))
    assert "copies" in offered("links: {x: {co")
    assert "pin_and_slot" in offered("couplings: [{kind: pin")


def test_dials_and_pitch_circles_turn_by_exact_speeds(sheet: Page) -> None:
    turns = sheet.locator("#try .turns")
    turns.evaluate("(each) => { each.value = 1; each.dispatchEvent(new Event('input')); }")
    hand = sheet.locator("#try .dial .hand").first.get_attribute("transform") or ""
    assert float(re.findall(r"-?[\d.]+", hand)[0]) == pytest.approx(-360 * 2 / 7)
    planet = sheet.locator("#try .plan g", has=sheet.locator("title:text('p, on planet')"))
    place = planet.get_attribute("transform") or ""
    sheet.locator("#try .play").click()
    expect(planet).not_to_have_attribute("transform", place)
    sheet.locator("#try .play").click()
    turns.evaluate("(each) => { each.value = 7; each.dispatchEvent(new Event('input')); }")
    x, y, _ = (float(each) for each in re.findall(r"-?\d[\d.e-]*", planet.get_attribute("transform") or ""))
    turns.evaluate("(each) => { each.value = 0; each.dispatchEvent(new Event('input')); }")
    u, v, _ = (float(each) for each in re.findall(r"-?\d[\d.e-]*", planet.get_attribute("transform") or ""))
    assert (x, y) == pytest.approx((u, v), abs=1e-9), "after 7 turns of the sun the carrier has made 2"
    assert x**2 + y**2 == pytest.approx((12 + 9) ** 2)


def test_an_address_holds_a_text_and_its_page_answers_it(
    opened: tuple[Page, list[str]], context: BrowserContext, address: str
) -> None:
    sheet, wrong = opened
    replace(sheet, "A simple planetary", "Mine, ünd more")
    sheet.locator("#try .share").click()
    sheet.wait_for_function("location.hash.startsWith('#text=')")
    shared = sheet.evaluate("location.hash")
    context.set_offline(False)
    other = context.new_page()
    other.goto(address + "try.html" + shared)
    expect(other.locator("#try .cm-line", has_text="Mine, ünd more")).to_be_visible()
    assert text_of(other) == text_of(sheet)
    other.goto("about:blank")
    other.goto(address + "try.html#train=zf-8hp70")
    expect(other.locator("#try .state option")).to_have_count(9, timeout=START)
    other.set_viewport_size({"width": 390, "height": 800})
    assert other.evaluate("document.documentElement.scrollWidth <= innerWidth"), "it fits a phone"
    other.close()
    assert wrong == []


def test_from_disk_it_says_why_it_does_not_start(site: Path, browser: Browser) -> None:
    page = browser.new_page()
    page.goto((site / "try.html").as_uri())
    expect(page.locator("#try-absent")).to_be_visible()
    page.close()
