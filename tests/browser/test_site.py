"""Site as published, with a few trains in its gallery: opened from disk, and its page for trying the package, served
without a network.

One file, so that the site is built once.
"""

from __future__ import annotations

import importlib
import json
import re
from collections.abc import Iterator
from functools import partial
from html.parser import HTMLParser
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any
from urllib.parse import unquote, urlsplit

import gallery
import numpy as np
import pytest
import shipped
import yaml
from conftest import OpenWindow
from package.test_public_names import SHOWING
from PIL import Image
from places import train_files
from playwright.sync_api import Browser, BrowserContext, Page, expect
from viewing import GALLERY, listen

ROOT = Path(__file__).parent.parent.parent
DOCS = sorted(
    path.relative_to(ROOT / "docs").as_posix()
    for folder in (ROOT / "docs", ROOT / "docs" / "api")
    for path in folder.glob("*.md")
)
NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.ipynb"))
ACCURACY = sorted(name for name in DOCS if "accuracy" in name)


class Links(HTMLParser):
    """Links of a page, the files that it loads, and its anchors."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.fetched: list[str] = []
        self.ids: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = {key: value or "" for key, value in attrs}
        self.ids |= {found[key] for key in ("id", "name") if key in found}
        if tag == "a" and "href" in found:
            self.links.append(found["href"])
        self.fetched += [found[key] for key in ("src", "srcset", "data", "poster") if key in found]
        if tag == "link" and found.get("rel") not in ("canonical", "next", "prev"):
            self.fetched.append(found.get("href", ""))


def pages(site: Path) -> Iterator[Path]:
    """Return the pages of the documentation, without those of trains and without the error page."""
    found = sorted([*site.glob("*.html"), *site.glob("api/*.html")])
    return (path for path in found if path.name != "404.html")


def test_the_navigation_lists_every_page_once() -> None:
    nav = re.findall(r"([\w/-]+\.md)$", (ROOT / "mkdocs.yml").read_text(encoding="utf-8"), re.M)
    books = [f"notebooks/{path.stem}.md" for path in NOTEBOOKS]
    assert sorted(nav) == sorted([*DOCS, *books])


def test_notebooks_are_kept_without_outputs_and_shown_with_them(site: Path, sheet: tuple[Page, list[str]]) -> None:
    assert {path.stem for path in NOTEBOOKS} == {"historian", "engineer", "maker", "study"}
    for path in NOTEBOOKS:
        cells = [cell for cell in json.loads(path.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "code"]
        assert not any(cell["outputs"] for cell in cells)
        page, _ = sheet
        page.goto((site / "notebooks" / f"{path.stem}.html").as_uri())
        pictures = page.locator("article img")
        assert pictures.count() == sum(len(re.findall(r"\.(?:draw|plot)\(", cell["source"][-1])) for cell in cells)
        sizes = page.evaluate("[...document.querySelectorAll('article img')].map((each) => each.naturalWidth)")
        assert all(width > 100 for width in sizes), "each is drawn"
    page.goto((site / "notebooks" / "engineer.html").as_uri())
    assert "3000/7" in page.locator("article").inner_text(), "24/84 of 1500 rpm"
    page.goto((site / "notebooks" / "historian.html").as_uri())
    frame = page.frame_locator("article iframe")
    frame.locator("canvas").first.wait_for(state="attached")


def test_every_page_is_in_the_site_those_of_accuracy_with_their_pictures(site: Path) -> None:
    shown = {path.relative_to(site).with_suffix("").as_posix() for path in pages(site)}
    assert shown == {name.removesuffix(".md") for name in DOCS}
    assert len(ACCURACY) >= 3
    for name in ACCURACY:
        shown = Links(site / name.replace(".md", ".html")).fetched
        printed = re.findall(r"!\[[^]]*\]\((images/[^)]+)\)", (ROOT / "docs" / name).read_text(encoding="utf-8"))
        assert set(printed) <= set(shown)
        assert all((site / picture).stat().st_size > 1000 for picture in printed)


def test_every_link_of_the_site_leads_to_a_file_and_to_a_name_in_it(site: Path) -> None:
    names = {path: Links(path).ids for path in pages(site)}
    checked = 0
    for page in pages(site):
        for link in Links(page).links:
            parts = urlsplit(link)
            if parts.scheme or link == "":
                continue
            target = (page.parent / unquote(parts.path)).resolve() if parts.path else page
            assert target.is_file() or (target / "index.html").is_file(), f"{page.name}: {link}"
            if parts.fragment and target in names:
                assert unquote(parts.fragment) in names[target], f"{page.name}: {link}"
                checked += 1
    assert checked > 1000


def test_nothing_is_fetched_from_elsewhere(site: Path) -> None:
    for page in pages(site):
        for address in Links(page).fetched:
            assert not re.match(r"(\w+:)?//", address), f"{page.name}: {address}"
            if not address.startswith("data:"):
                assert (page.parent / unquote(urlsplit(address).path)).is_file(), f"{page.name}: {address}"
    styles = "".join(path.read_text(encoding="utf-8") for path in site.rglob("*.css"))
    assert re.findall(r"url\(['\"]?(?:https?:)?//[^)]*", styles) == []
    assert re.findall(r"@import[^;]*", styles) == []


def test_what_makes_the_site_is_no_part_of_it(site: Path) -> None:
    assert [path.name for path in site.rglob("*.py")] == []
    assert not (site / "scripts").exists()
    assert not (site / "site").exists()


def test_the_gallery_has_picture_viewer_and_report_of_each_train(site: Path) -> None:
    found = Links(site / "gallery.html")
    for name in GALLERY:
        assert (site / "plan" / f"{name}.png").read_bytes().startswith(b"\x89PNG")
        assert {f"view/{name}.html", f"report/{name}.html"} <= set(found.links)
    text = (site / "gallery.html").read_text(encoding="utf-8")
    for path in train_files():
        assert f"<strong>{path.stem}</strong>" in text
    assert sorted(path.stem for path in (site / "view").iterdir()) == sorted(GALLERY)


def test_pictures_of_the_gallery_turn_under_the_pointer_and_open_the_train(
    site: Path, sheet: tuple[Page, list[str]]
) -> None:
    page, wrong = sheet
    for name in GALLERY:
        with Image.open(site / "film" / f"{name}.webp") as film, Image.open(site / "still" / f"{name}.webp") as still:
            assert film.n_frames > 10  # type: ignore[attr-defined]
            assert film.size == still.size
            first = np.asarray(film.convert("RGB"), dtype=int)
            assert np.abs(first - np.asarray(still.convert("RGB"), dtype=int)).mean() < 8, "it begins where it stood"
            film.seek(5)
            assert np.abs(first - np.asarray(film.convert("RGB"), dtype=int)).max() > 60, "it moves"
    shown = "(each) => getComputedStyle(each, '::after').backgroundImage"
    page.goto((site / "gallery.html").as_uri())
    picture = page.locator("a.turning[title=worm]")
    assert picture.evaluate(shown) == "none", "no film is fetched before it is wanted"
    page.emulate_media(reduced_motion="no-preference")
    picture.hover()
    assert picture.evaluate(shown).endswith('film/worm.webp")')
    page.emulate_media(reduced_motion="reduce")
    assert picture.evaluate(shown) == "none"
    picture.click()
    assert page.url.endswith("view/worm.html")
    assert wrong == []


def test_formulas_fit_their_column_and_pages_their_window(site: Path, sheet: tuple[Page, list[str]]) -> None:
    """A formula of several statements is broken into lines; on a phone it may be scrolled, but not the page."""
    page, _ = sheet
    told = "[...document.querySelectorAll('.formula')].filter((each) => each.scrollWidth > each.clientWidth + 1)"
    seen = 0
    for path in pages(site):
        if 'class="formula"' not in path.read_text(encoding="utf-8"):
            continue
        page.goto(path.as_uri(), wait_until="domcontentloaded")
        page.set_viewport_size({"width": 1280, "height": 800})
        assert page.evaluate(f"{told}.map((each) => each.innerText)") == [], path.name
        seen += page.locator(".formula").count()
        page.set_viewport_size({"width": 390, "height": 844})
        assert page.evaluate("document.documentElement.scrollWidth") == 390, path.name
    page.set_viewport_size({"width": 1100, "height": 800})
    assert seen > 100


def test_the_page_of_the_viewer_has_a_machine_that_turns(site: Path, sheet: tuple[Page, list[str]]) -> None:
    page, wrong = sheet
    page.emulate_media(reduced_motion="no-preference")
    page.goto((site / "viewer.html").as_uri())
    frame = page.frame_locator(".turning-frame iframe")
    frame.get_by_role("button", name="Stop").wait_for()
    said = frame.locator("output")
    before = said.inner_text()
    expect(said).not_to_have_text(before)
    assert wrong == []


def test_where_nothing_draws_the_pages_show_plans(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GEARTRAIN_BROWSER", "no-such-browser")
    gallery._draws.cache_clear()
    try:
        assert list(gallery._moving("worm", shipped.scene("worm"))) == []
    finally:
        gallery._draws.cache_clear()
    made = {f"{kind}/worm.{suffix}": Path() for kind, suffix in (("plan", "png"), ("view", "html"), ("report", "html"))}
    monkeypatch.setattr(gallery, "make", lambda: made)
    assert gallery._thumbnail("worm").startswith("[![plan of worm](plan/worm.png)")
    assert gallery.with_frames("<!-- turning: planetary -->\n![a](b)\n") == "![a](b)\n", "no frame of what is not made"


def test_the_readme_opens_with_a_mechanism_that_turns() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8").partition("## An example")[0]
    (picture,) = re.findall(r"!\[.*?\]\((.*?)\)", text)
    assert (ROOT / picture).stat().st_size < 1_000_000
    with Image.open(ROOT / picture) as film:
        assert film.n_frames >= 40  # type: ignore[attr-defined]


def test_the_gallery_tells_what_the_trains_declare() -> None:
    rows = re.findall(r"^\| ([\w.-]+) \| (.*?) \|", (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8"), re.M)
    titles = {name: title for name, title in rows if name != "train"}
    declared = {path.stem: yaml.safe_load(path.read_text(encoding="utf-8")) for path in train_files()}
    assert titles == {name: (data.get("title") or "").replace("|", "/") for name, data in declared.items()}


def test_formulas_are_shown_without_scripts_and_blocks_have_the_names_of_their_files(site: Path) -> None:
    theory = (site / "theory.html").read_text(encoding="utf-8")
    source = re.sub(r"^```.*?^```", "", (ROOT / "docs" / "theory.md").read_text(encoding="utf-8"), flags=re.S | re.M)
    assert theory.count("<math") == len(re.findall(r"\$\$.+?\$\$|\$[^$\n]+(?:\n[^$\n]+)?\$", source, re.S))
    assert theory.count('class="number"') == source.count(r"\tag{")
    assert not re.search(r"\\(?:frac|omega|tag|tau)", re.sub(r"<code>.*?</code>", "", theory, flags=re.S))
    assert ">nodes.yaml<" in (site / "tutorial.html").read_text(encoding="utf-8")


def test_the_reference_of_python_is_made_from_the_docstrings(site: Path) -> None:
    texts = {path: path.read_text(encoding="utf-8") for path in site.glob("api/*.html")}
    assert not any(":::" in text for text in texts.values())
    names = {name for path in texts for name in Links(path).ids}
    rooms = [f"geartrain.{room}" for room in SHOWING]
    wanted = {f"{room}.{name}" for room in rooms for name in importlib.import_module(room).__all__}
    assert wanted - names == set()
    assert {"geartrain.analysis.load", "geartrain.analysis.GearTrain.solve", "geartrain.viewer.page"} <= names
    assert re.search(r">Parameters:</span>", texts[site / "api" / "analysis.html"]), "sections of numpydoc are read"


# ------------------------------------------------------------------------------------------------------- in a browser


@pytest.fixture
def sheet(open_window: OpenWindow) -> tuple[Page, list[str]]:
    """Page of the browser, with a list of errors and of requests to addresses other than files."""
    page = open_window(viewport={"width": 1100, "height": 800})
    return page, listen(page, "file:", "data:")


@pytest.mark.parametrize("name", ["index", "theory", "gallery", "api/index", "api/analysis"])
def test_a_page_opens_from_disk_without_errors_or_requests(
    name: str, site: Path, sheet: tuple[Page, list[str]]
) -> None:
    page, wrong = sheet
    page.goto((site / f"{name}.html").as_uri())
    page.wait_for_load_state("networkidle")
    assert wrong == []
    assert page.evaluate("[...document.images].filter(each => each.complete && !each.naturalWidth).length") == 0
    page.set_viewport_size({"width": 390, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "it fits a phone"


def test_the_search_finds_pages_from_disk(site: Path, sheet: tuple[Page, list[str]]) -> None:
    page, wrong = sheet
    page.goto((site / "index.html").as_uri())
    page.locator("input.md-search__input").click()
    page.keyboard.type("self-locking", delay=20)
    page.wait_for_selector(".md-search-result__link")
    assert "torques" in " ".join(page.locator(".md-search-result__link").evaluate_all("all => all.map(a => a.href)"))
    assert wrong == []


def test_light_and_dark_can_be_chosen(site: Path, sheet: tuple[Page, list[str]]) -> None:
    page, wrong = sheet
    page.goto((site / "index.html").as_uri())
    scheme = "document.body.getAttribute('data-md-color-scheme')"
    before = page.evaluate(scheme)
    page.locator("label[for^=__palette]:visible").first.click()
    assert {before, page.evaluate(scheme)} == {"default", "slate"}
    assert wrong == []


def test_pages_of_the_site_have_their_diagrams_in_light_and_dark_and_on_phones(
    site: Path, open_window: OpenWindow
) -> None:
    page = open_window(offline=True)
    wrong = listen(page, "file:", "data:", "blob:")
    for path in sorted((ROOT / "docs").glob("*.md")):
        if count := path.read_text(encoding="utf-8").count("<!-- diagram: "):
            page.set_viewport_size({"width": 1280, "height": 720})
            page.goto((site / f"{path.stem}.html").as_uri())
            assert page.locator("gear-diagram.gd-alive").count() == count, path.stem
            paper = "getComputedStyle(document.querySelector('.gd-live')).backgroundColor"
            colours = set()
            for scheme in ("default", "slate"):
                page.evaluate("(scheme) => document.body.setAttribute('data-md-color-scheme', scheme)", scheme)
                colours.add(page.evaluate(paper))
            assert len(colours) == 2
            page.set_viewport_size({"width": 390, "height": 844})
            assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), path.stem
            assert wrong == []


# -------------------------------------------------------------------------------------- page for trying the package

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
    context = browser.new_context(viewport={"width": 1300, "height": 900}, reduced_motion="reduce")
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
def editor(opened: tuple[Page, list[str]]) -> Page:
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


def test_the_trial_answers_exactly_and_asks_nobody(opened: tuple[Page, list[str]]) -> None:
    editor, wrong = opened
    assert editor.locator("#try .verdict").inner_text() == "determined: every speed follows from sun"
    assert dial(editor, "carrier") == "2/7", "24 / (24 + 60)"
    report = editor.frame_locator("#try .page iframe")
    expect(report.locator("h2", has_text="Adjacency matrix").first).to_be_visible()
    expect(report.locator("h2", has_text="Fundamental circuits")).to_be_visible()
    assert wrong == []


def test_without_a_network_it_answers_what_is_typed(editor: Page) -> None:
    replace(editor, "{s: 24}", "{s: 30}")
    replace(editor, "{p: 18}", "{p: 15}")
    expect(editor.locator("#try .dial code").first).to_have_text("1/3")  # 30 / (30 + 60)
    expect(editor.locator("#try .problems .error").first).to_contain_text("2/7")
    replace(editor, "{s: 30}", "{s: 24}")
    replace(editor, "{p: 15}", "{p: 18}")
    expect(editor.locator("#try .verdict.good")).to_be_visible()


def test_an_error_stands_under_its_line_with_its_cure(editor: Page) -> None:
    number = text_of(editor).splitlines().index("inputs: {sun: 1}") + 1
    replace(editor, "inputs", "input")
    error = editor.locator("#try .problems .error", has_text=f"line {number}:")
    expect(error).to_contain_text("did you mean 'inputs'?")
    expect(editor.locator("#try .cm-lint-marker-error")).to_be_visible()
    expect(editor.locator("#try .cm-lintRange-error")).to_have_text("input: {sun: 1}")
    replace(editor, "input", "inputs")
    expect(editor.locator("#try .cm-lint-marker-error")).to_have_count(0)


def test_it_completes_keys_by_their_place_and_names_of_the_train(editor: Page) -> None:
    last = editor.locator("#try .cm-line").last
    chooser = editor.locator("#try .example")

    def offered(*typed: str) -> list[str]:
        last.click()
        editor.keyboard.press("Control+End")
        for each in typed[:-1]:
            editor.keyboard.insert_text(each)
            editor.keyboard.press("Enter")
        editor.keyboard.insert_text(typed[-1])
        editor.keyboard.press("Control+Space")
        options = editor.locator("#try .cm-tooltip-autocomplete li")
        options.first.wait_for()
        found = options.all_inner_texts()
        editor.keyboard.press("Escape")
        chooser.select_option("worm")
        chooser.select_option("planetary-24-18-60")
        expect(editor.locator("#try .verdict.good")).to_be_visible()
        return found

    assert "couplings" in offered("coup")
    assert {"carrier", "planet"} <= set(offered("fixed: ["))
    assert "copies" in offered("links: {x: {co")
    assert "pin_and_slot" in offered("couplings: [{kind: pin")


def test_dials_and_pitch_circles_turn_by_exact_speeds(editor: Page) -> None:
    turns = editor.locator("#try .turns")
    turns.evaluate("(each) => { each.value = 1; each.dispatchEvent(new Event('input')); }")
    hand = editor.locator("#try .dial .hand").first.get_attribute("transform") or ""
    assert float(re.findall(r"-?[\d.]+", hand)[0]) == pytest.approx(-360 * 2 / 7)
    planet = editor.locator("#try .plan g", has=editor.locator("title:text('p, on planet')"))
    place = planet.get_attribute("transform") or ""
    editor.locator("#try .play").click()
    expect(planet).not_to_have_attribute("transform", place)
    editor.locator("#try .play").click()
    turns.evaluate("(each) => { each.value = 7; each.dispatchEvent(new Event('input')); }")
    x, y, _ = (float(each) for each in re.findall(r"-?\d[\d.e-]*", planet.get_attribute("transform") or ""))
    turns.evaluate("(each) => { each.value = 0; each.dispatchEvent(new Event('input')); }")
    u, v, _ = (float(each) for each in re.findall(r"-?\d[\d.e-]*", planet.get_attribute("transform") or ""))
    assert (x, y) == pytest.approx((u, v), abs=1e-9), "after 7 turns of the sun the carrier has made 2"
    assert x**2 + y**2 == pytest.approx((12 + 9) ** 2)


def test_an_address_holds_a_text_and_its_page_answers_it(
    opened: tuple[Page, list[str]], context: BrowserContext, address: str
) -> None:
    editor, wrong = opened
    replace(editor, "A simple planetary", "Mine, ünd more")
    editor.locator("#try .share").click()
    editor.wait_for_function("location.hash.startsWith('#text=')")
    shared = editor.evaluate("location.hash")
    context.set_offline(False)
    other = context.new_page()
    other.goto(address + "try.html" + shared)
    expect(other.locator("#try .cm-line", has_text="Mine, ünd more")).to_be_visible()
    assert text_of(other) == text_of(editor)
    other.goto("about:blank")
    other.goto(address + "try.html#train=zf-8hp70")
    expect(other.locator("#try .state option")).to_have_count(9, timeout=START)
    other.set_viewport_size({"width": 390, "height": 800})
    assert other.evaluate("document.documentElement.scrollWidth <= innerWidth"), "it fits a phone"
    other.close()
    assert wrong == []


def test_from_disk_the_trial_says_why_it_does_not_start(site: Path, open_window: OpenWindow) -> None:
    page = open_window()
    page.goto((site / "try.html").as_uri())
    expect(page.locator("#try-absent")).to_be_visible()
