"""Page of a report in use: sorted, copied, printed, read on a phone, in the light and the dark theme."""

from __future__ import annotations

import re
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest
import shipped
from conftest import OpenWindow
from playwright.sync_api import Locator, Page
from viewing import contrast, listen, luminance

from geartrain import load
from geartrain.drawing import picture, render
from geartrain.report import Document, Picture, Section, Table, collect_report, to_html
from geartrain.report.document import Branch, PageExtras, SceneText
from geartrain.report.train_report import describe_shared_page
from geartrain.scene import build_scene
from geartrain.viewer import page as viewer_page

EVIL = "<script>alert(1)</script>\"'><img src=x onerror=alert(2)>"
SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="720pt" height="72pt"><path d="M 0 0 L 720 72" stroke="red"/></svg>'
)
Opened = Callable[..., tuple[Page, list[str]]]


@pytest.fixture
def open_report(open_window: OpenWindow, tmp_path: Path) -> Opened:
    """Function that returns an opened page with a list of errors, dialogs and requests to other addresses."""

    def show(text: str, **window: object) -> tuple[Page, list[str]]:
        path = tmp_path / "report.html"
        path.write_text(text, encoding="utf-8")
        page = open_window(**({"viewport": {"width": 1000, "height": 800}} | window))
        wrong = listen(page, path.as_uri(), "data:", "blob:", "about:")
        page.goto(path.as_uri())
        page.evaluate("document.querySelectorAll('details').forEach((each) => { each.open = true; })")
        return page, wrong

    return show


def table(page: Page, heading: str) -> list[list[str]]:
    """Return the rows of the first table below a heading."""
    script = """heading => {
      const section = [...document.querySelectorAll("section")].find(
        (each) => each.querySelector("h2").textContent === heading);
      return [...section.querySelector("table").rows].map((row) => [...row.cells].map((cell) => cell.innerText.trim()));
    }"""
    return page.evaluate(script, heading)


def sort_by(page: Page, heading: str, column: str) -> list[str]:
    """Click the head of a column, and return its cells."""
    section = page.locator("section", has=page.locator("h2", has_text=heading)).first
    section.locator("thead button", has_text=column).first.click()
    head, *rows = table(page, heading)
    return [row[head.index(column)] for row in rows]


@pytest.fixture(scope="module")
def freeth() -> str:
    return to_html([describe_shared_page(shipped.report("freeth-2008"), [Picture("a line", SVG)])])


def test_a_click_sorts_fractions_by_their_exact_size_and_another_turns_them_round(
    freeth: str, open_report: Opened
) -> None:
    page, wrong = open_report(freeth)
    before = [row[1] for row in table(page, "Speeds")[1:]]
    rising, falling = (sort_by(page, "Speeds", "speed") for _ in range(2))
    assert sorted(rising) == sorted(before)
    assert [Fraction(cell) for cell in rising] == sorted(Fraction(cell) for cell in before)
    assert [Fraction(cell) for cell in falling] == sorted((Fraction(cell) for cell in before), reverse=True)
    assert rising != before
    heads = page.locator("th[aria-sort]").evaluate_all("all => all.map(head => head.getAttribute('aria-sort'))")
    assert heads == ["descending"]
    page.locator("section#speeds thead button").nth(1).focus()
    page.keyboard.press("Enter")
    assert page.locator("th[aria-sort=ascending]").count() == 1, "the keyboard reaches what a click does"
    assert wrong == []


def test_names_are_sorted_as_people_count_and_cells_without_a_value_come_last(open_report: Opened) -> None:
    page, wrong = open_report(to_html([describe_shared_page(shipped.report("pennestri-2002"))]))
    names = sort_by(page, "Structure", "link")
    assert [int(name) for name in names] == sorted(int(name) for name in names)
    ratios = sort_by(page, "Speeds", "output : input")
    assert "-" in ratios
    assert ratios.index("-") == len(ratios) - ratios.count("-")
    shown = [cell.split(" : ") for cell in ratios if cell != "-"]
    sizes = [Fraction(a) / Fraction(b) for a, b in shown]
    assert sizes == sorted(sizes)
    assert wrong == []


def test_a_click_copies_the_exact_value(freeth: str, open_report: Opened) -> None:
    page, wrong = open_report(freeth, permissions=["clipboard-read", "clipboard-write"])
    page.locator("td[data-exact='254/19'] button").first.click()
    page.locator("#said", has_text="254/19").wait_for(state="attached")
    assert page.evaluate("navigator.clipboard.readText()") == "254/19"
    assert wrong == []


def test_a_train_named_like_a_script_is_harmless(train_file: Callable[..., Path], open_report: Opened) -> None:
    quoted = EVIL.replace("'", "''")
    path = train_file(
        f"extends: worm\nname: '{quoted}'\ntitle: '{quoted}'\nnote: '{quoted}'\n"
        f"sources: {{'{quoted}': {{cite: '{quoted}', url: 'javascript:alert(3)'}}}}\n"
    )
    page, wrong = open_report(to_html([describe_shared_page(collect_report(load(path)))]))
    assert page.title() == EVIL
    assert page.locator("h1").inner_text() == EVIL
    assert wrong == []
    assert page.evaluate("[...document.querySelectorAll('a')].every(a => /^(#|https?:)/.test(a.getAttribute('href')))")


def test_a_script_smuggled_into_a_page_would_not_run(freeth: str, open_report: Opened) -> None:
    page, wrong = open_report(freeth.replace("<article>", "<article><script>document.title = 'taken'</script>", 1))
    assert page.title() != "taken"
    assert any("Content Security Policy" in said for said in wrong)


def test_a_script_in_the_frame_cannot_reach_the_page_round_it(open_report: Opened) -> None:
    inner = "<p>inside</p><script>document.title = 'inside'; parent.document.title = 'taken'</script>"
    page, wrong = open_report(to_html([describe_shared_page(shipped.report("worm"), viewer=inner)]))
    (frame,) = [each for each in page.frames if each.parent_frame]
    frame.wait_for_selector("p")
    assert frame.title() == "inside", "scripts run in the frame"
    assert page.title() == shipped.train("worm").declaration.title
    assert len(wrong) == 1
    assert "Blocked a frame" in wrong[0]


def test_all_is_there_without_scripts(freeth: str, open_report: Opened) -> None:
    page, wrong = open_report(freeth, java_script_enabled=False)
    assert page.locator("table").count() > 5
    assert page.locator("section button").count() == 0
    assert page.locator("figure svg").count() == 1
    assert wrong == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_words_stand_out_from_their_paper_in_light_and_dark(scheme: str, freeth: str, open_report: Opened) -> None:
    page, _ = open_report(freeth, color_scheme=scheme)
    script = """() => ["body", "h2", ".badge", "a", "td button"].map((name) => {
      const colour = getComputedStyle(document.querySelector(name)).color;
      return [colour, getComputedStyle(document.body).backgroundColor];
    })"""
    for ink, paper in page.evaluate(script):
        assert contrast(ink, paper) >= 4.5, f"{ink} on {paper}"
    assert (luminance(page.evaluate(script)[0][1]) < 0.2) == (scheme == "dark")


def test_it_fits_a_phone_and_pictures_shrink_with_it(freeth: str, open_report: Opened) -> None:
    page, wrong = open_report(freeth, viewport={"width": 360, "height": 740})
    assert page.evaluate("document.documentElement.scrollWidth") <= 360
    assert 200 < page.locator("figure svg").evaluate("each => each.getBoundingClientRect().width") <= 360
    assert wrong == []


def test_it_prints_on_white_without_what_can_only_be_clicked(freeth: str, open_report: Opened) -> None:
    page, wrong = open_report(freeth, color_scheme="dark")
    assert page.locator("nav.contents").is_visible()
    page.emulate_media(media="print")
    assert not page.locator("nav.contents").is_visible()
    paper, ink = page.evaluate("(s => [s.backgroundColor, s.color])(getComputedStyle(document.body))")
    assert (paper, ink) == ("rgb(255, 255, 255)", "rgb(0, 0, 0)")
    assert page.pdf(format="A4").startswith(b"%PDF")
    assert page.evaluate("document.querySelector('.scroll').clientHeight > 0")
    assert wrong == []


def test_the_first_screen_has_the_verdict_the_pointers_and_a_picture(open_window: OpenWindow, tmp_path: Path) -> None:
    """A window of 1280 x 800 pixels, with the plan and the dials of a train of 24 outputs."""
    train = shipped.train("freeth-2021")
    drawings = [
        Picture("drawn", render(each, ".svg").decode()) for each in (picture(train, "plan"), picture(train, "dials"))
    ]
    path = tmp_path / "report.html"
    text = to_html([describe_shared_page(shipped.report("freeth-2021"), drawings)])
    path.write_text(text, encoding="utf-8")
    page = open_window(viewport={"width": 1280, "height": 800})
    page.goto(path.as_uri())
    names = (".badge", "article > p:has-text('Verdict')", "table", "figure", "nav.contents")
    places = [page.locator(name).first.bounding_box() for name in names]
    badge, verdict, table, figure, contents = (place for place in places if place is not None)
    assert badge["y"] < verdict["y"] < min(table["y"], figure["y"])
    assert table["x"] + table["width"] < figure["x"]
    assert max(each["y"] + each["height"] for each in (badge, verdict, figure)) < 800
    assert table["y"] < 250
    assert contents["y"] > max(each["y"] + each["height"] for each in (table, figure))
    for heading in ("Formulas", "Fundamental circuits", "Adjacency matrix", "Wheels and their sources"):
        folded = page.locator("details", has=page.get_by_role("heading", name=heading, exact=True))
        assert folded.count() == 1
        assert folded.get_attribute("open") is None
    pages = page.pdf(format="A4", margin=dict.fromkeys(("top", "bottom", "left", "right"), "10mm"))
    assert len(re.findall(rb"/Type\s*/Page\b", pages)) <= 4


def test_a_click_on_a_rank_shows_its_train_turning(open_report: Opened) -> None:
    trains = [shipped.train(name) for name in ("planetary-24-18-60", "worm", "bevel-differential")]
    viewer = viewer_page([build_scene(train) for train in trains])
    cells = [[SceneText(str(rank), rank), EVIL] for rank in (1, 2, 3)]
    sections = [Section("The best", (), [Table(("rank", "name"), cells)], [Branch(SceneText("the third", 3))])]
    page, wrong = open_report(to_html([Document("Trains", (), sections, PageExtras(viewer=viewer))]))

    def shown(number: int, by: Locator) -> None:
        by.click()
        name = trains[number - 1].name
        for _ in range(600):
            page.wait_for_timeout(100)
            (frame,) = [each for each in page.frames if each.parent_frame]
            if frame.evaluate("globalThis.geartrain?.ready && geartrain.scenes[0].name") == name:
                break
        assert frame.evaluate("geartrain.scenes[0].name") == name
        assert frame.evaluate("geartrain.scenes.length") == 3, "the others can still be chosen"

    shown(2, page.locator("th[data-scene='2'] button"))
    shown(3, page.locator(".tree button"))
    shown(1, page.locator("th[data-scene='1'] button"))
    assert wrong == []
