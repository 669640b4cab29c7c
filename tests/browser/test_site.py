"""Site as published, with a few trains in its gallery, opened from disk in a browser."""

from __future__ import annotations

import importlib
import json
import re
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import gallery
import numpy as np
import pytest
import shipped
import yaml
from package.test_public_names import SHOWING
from PIL import Image
from places import train_files
from playwright.sync_api import Browser, Page, expect
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
    assert {path.stem for path in NOTEBOOKS} == {"historian", "engineer", "maker"}
    for path in NOTEBOOKS:
        cells = [cell for cell in json.loads(path.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "code"]
        assert not any(cell["outputs"] for cell in cells)
        page, _ = sheet
        page.goto((site / "notebooks" / f"{path.stem}.html").as_uri())
        pictures = page.locator("article img")
        assert pictures.count() == sum(cell["source"][-1].count(".draw(") for cell in cells)
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
    picture.hover()
    assert picture.evaluate(shown).endswith('film/worm.webp")')
    page.emulate_media(reduced_motion="reduce")
    assert picture.evaluate(shown) == "none"
    page.emulate_media(reduced_motion="no-preference")
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
def sheet(browser: Browser) -> Iterator[tuple[Page, list[str]]]:
    """Page of the browser, with a list of errors and of requests to addresses other than files."""
    context = browser.new_context(viewport={"width": 1100, "height": 800})
    sheet = context.new_page()
    yield sheet, listen(sheet, "file:", "data:")
    context.close()


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
