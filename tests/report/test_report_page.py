"""The page of a report as another reader finds it: an HTML parser that knows nothing of geartrain."""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.parse import urlsplit
from xml.etree import ElementTree

import pytest
from commands import LOCKED, call, without
from html_reader import Read
from markdown_it import MarkdownIt

from geartrain import load
from geartrain.report import Branch, Document, Picture, Section, Table, collect_report, to_html, to_markdown
from geartrain.report.html_page import inline
from geartrain.report.train_report import describe_shared_page

SVG = (
    '<?xml version="1.0"?><!DOCTYPE svg><svg xmlns="http://www.w3.org/2000/svg" width="10pt" height="5pt" '
    'viewBox="0 0 10 5">'
    '<defs><path id="a" d="M 0.123456 1 L 2 3"/></defs><g clip-path="url(#a)"><use href="#a"/></g></svg>'
)


def page_of(*names: str, pictures: tuple[Picture, ...] = (), viewer: str = "") -> Read:
    return Read(to_html([describe_shared_page(collect_report(load(name)), pictures, viewer) for name in names]))


@pytest.mark.parametrize("names", [("freeth-2021",), ("zf-8hp70", "worm", "worm")])
def test_every_link_of_the_contents_leads_to_one_place_of_the_page(names: tuple[str, ...]) -> None:
    page = page_of(*names, pictures=(Picture("one", SVG), Picture("two", SVG)), viewer="<p>turns</p>")
    targets = [attrs["href"][1:] for attrs in page.all("a") if attrs["href"].startswith("#")]
    assert len(page.ids) == len(set(page.ids)), "no name is given twice"
    assert set(targets) <= set(page.ids)
    sections = [attrs["id"] for attrs in page.all("section")]
    assert len(sections) > 5 * len(names)
    assert set(sections) <= set(targets), "the contents leave no section out"


def test_the_badge_tells_the_worst_that_is_known_of_a_train(train_file: Callable[..., Path]) -> None:
    def badge(text: str) -> str:
        shown = to_html([describe_shared_page(collect_report(load(train_file(text))))])
        found = re.search(r'<div class="badge( bad)?">(.*?)</div>', shown)
        assert found
        return ("BAD " if found[1] else "") + found[2]

    sound = LOCKED.replace(", {pair: [z, x]}", "")
    assert badge(sound) == "determined"
    assert badge(LOCKED) == "BAD locked"
    assert badge(sound + "outputs:\n  c: {expect: 1/3}\n") == "BAD 1 expectation failed"
    assert badge(sound.replace("inputs: {a: 1}", "states: {x: {inputs: {a: 1}}, y: {}}")) == "BAD free in 1 of 2 states"


def test_exact_values_can_be_copied_whole_where_they_are_shortened(
    train_file: Callable[..., Path], tmp_path: Path
) -> None:
    wheels = [f"c{at}: {{wheels: {{i{at}: {10**9 + 2 * at + 1}, o{at}: {10**9 - 2 * at - 1}}}}}" for at in range(8)]
    text = (
        f"links: {{frame: {{}}, {', '.join(wheels)}}}\n"
        f"revolutes: [{', '.join(f'{{pair: [frame, c{at}], axis: A{at}}}' for at in range(8))}]\n"
        f"gears: [{', '.join(f'{{pair: [o{at}, i{at + 1}]}}' for at in range(7))}]\n"
        "inputs: {c0: 1}\n"
    )
    train = load(train_file(text))
    speed = str(train.solve()["c7"])
    assert len(speed) > 100
    page = Read(to_html([describe_shared_page(collect_report(train))]))
    assert speed in {attrs.get("data-exact") for attrs in page.all("td")}
    assert speed not in page.text
    assert "digits)/(" in page.text
    call("compare", "freeth-2008", "price-1974", "-o", tmp_path / "c.html")
    compared = Read((tmp_path / "c.html").read_text(encoding="utf-8"))
    assert {"254/19", "-254/19"} <= {attrs.get("data-exact") for attrs in compared.all("td")}


def test_sources_stand_at_the_end_and_wheels_lead_to_them(train_file: Callable[..., Path]) -> None:
    path = train_file(
        """
        extends: worm
        sources:
          good: {cite: a paper, url: "https://example.org/a?b=1&c=2", note: read it}
          bad: {cite: a trap, url: "javascript:alert(1)"}
          data: {cite: a trap, url: "data:text/html,<script>alert(1)</script>"}
          blank: {cite: a trap, url: " javascript:alert(1)"}
          host: {cite: a trap, url: "//example.org"}
          port: {cite: a trap, url: "https://["}
          shelf: {cite: a book, url: shelf 3}
        links:
          wheel: {wheels: {extra: {teeth: 30, source: good, status: surviving, note: "<b>worn</b>"}}}
        """
    )
    page = Read(to_html([describe_shared_page(collect_report(load(path)))]))
    links = [attrs["href"] for attrs in page.all("a")]
    assert "https://example.org/a?b=1&c=2" in links
    assert all(link.startswith(("#", "https://")) for link in links)
    assert "javascript:alert(1)" in page.text, "it is shown, and no link"
    assert "<b>worn</b>" in page.text
    (cited,) = {link for link in links if link.startswith("#source-")}
    assert cited[1:] in page.ids
    assert "Source good: a paper" not in page.text
    assert "Source good: a paper" in str(load(path).report())


LIVE = (
    *("[a](http://example.org/x?y=1#z)", "[a](HTTPS://example.org)", "[a](mailto:somebody@example.org)"),
    *("[a](trains/worm.yaml)", "[a](#source-x)", "[a](/x:y)", "![a](picture.svg)", "[a]\n\n[a]: https://example.org"),
)
DEAD = (
    *("[a](javascript:alert(1))", "[a](JaVaScRiPt:alert(1))", "[a](< javascript:alert(1)>)", "[a](<javascript:x y>)"),
    *("[a](&#106;avascript:alert(1))", "[a](javascript&colon;alert(1))", "[a](&#x6A;avascript:alert(1))"),
    *(
        "[a](  javascript:alert(1))",
        "[a](\njavascript:alert(1))",
        "[a](java\tscript:alert(1))",
        "[a](\x01javascript:x)",
    ),
    *("[a](javascript\\:alert(1))", "[a](\\javascript:alert(1))", "[a](java\nscript:alert(1))"),
    *("[a](data:text/html,<script>alert(1)</script>)", "![a](data:image/svg+xml;base64,PHN2Zz4=)", "[a](vbscript:x)"),
    *(
        "<javascript:alert(1)>",
        '<a href="javascript:alert(1)">a</a>',
        "<a\nhref=javascript:x>a</a>",
        "[a](file:///etc)",
    ),
    *("[a]\n\n[a]: javascript:alert(1)", "[a]\n\n[a]:\n  <javascript:alert(1)>", "[a][b]\n\n[b]: data:text/html,x"),
    *("[![a](picture.svg)](javascript:alert(1))", "[a](b [c](javascript:alert(1))", "[a] [b](javascript:alert(1) 'c')"),
)


def rendered(text: str) -> Iterator[str]:
    """What two readers of Markdown that check no address make of it."""
    markdown = pytest.importorskip("markdown")
    reader = MarkdownIt("commonmark", {"html": True}).enable("table")
    reader.validateLink = lambda url: True  # type: ignore[method-assign]
    yield reader.render(text)
    yield markdown.markdown(text, extensions=["tables"])


def addresses(text: str) -> set[str]:
    """Schemes of what a browser would follow or load, or "" where there is none; it drops blanks within."""
    found = [
        (tag, re.sub(r"[\x00-\x20]", "", str(attrs[key])))
        for page in rendered(text)
        for tag, attrs in Read(page).elements
        for key in ("href", "src")
        if key in attrs
    ]
    return {urlsplit(address).scheme for _, address in found}


@pytest.mark.parametrize("text", LIVE)
def test_a_note_may_lead_to_the_web_to_mail_and_to_files_beside_it(text: str) -> None:
    document = Document("A note", [text], [Section("Wheels", [text])])
    assert addresses(to_markdown([document])) == addresses(text) != set()
    assert addresses(text) <= {"http", "https", "mailto", ""}


@pytest.mark.parametrize("text", DEAD)
def test_no_other_address_of_a_note_is_followed(text: str) -> None:
    assert addresses(text) - {"http", "https", "mailto", ""} or "script" in text, "the readers check nothing"
    branch, table = Branch(text), Table(("a", text), [(text, "b")])
    document = Document(text, [text], [Section(text, [text], [table], [branch])])
    assert addresses(to_markdown([document])) <= {"http", "https", "mailto", ""}


def test_prose_with_brackets_stays_as_it_is() -> None:
    text = "As in [3]: wheels of 2:1 (see [4](page)), `f[x](y)`, speeds [1, 2]: both; [5](notes 2)."
    assert text in to_markdown([Document("A note", [text], [])])


def test_what_a_user_writes_stays_text_and_the_only_script_is_known_by_its_hash(
    train_file: Callable[..., Path],
) -> None:
    evil = "<script>alert(1)</script>\"'><img src=x onerror=alert(2)>"
    path = train_file(f"extends: worm\nname: {evil!r}\ntitle: {evil!r}\nnote: {evil!r}\n".replace("\\'", "''"))
    train = load(path)
    assert train.declaration.title == evil
    page = Read(to_html([describe_shared_page(collect_report(train), notes=[evil])]))
    assert page.text.count(evil) >= 3
    assert [tag for tag, _ in page.elements if tag in ("img", "iframe", "object", "link", "form")] == []
    assert not any(key.startswith("on") for _, attrs in page.elements for key in attrs)
    (script,) = page.scripts
    (policy,) = [attrs["content"] for attrs in page.all("meta") if "http-equiv" in attrs]
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert f"script-src 'sha256-{digest}'" in policy
    assert policy.startswith("default-src 'none'")
    assert "http" not in policy


def test_pictures_stand_inline_with_names_of_their_own_and_nothing_lost() -> None:
    first, second = (ElementTree.fromstring(inline(SVG, number)) for number in (1, 2))
    for number, element in ((1, first), (2, second)):
        names = [each.get("id") for each in element.iter() if each.get("id")]
        assert names == [f"p{number}-a"]
        assert [each.get("href") for each in element.iter() if each.get("href")] == [f"#p{number}-a"]
        assert [each.get("clip-path") for each in element.iter() if each.get("clip-path")] == [f"url(#p{number}-a)"]
        assert element.get("viewBox") == "0 0 10 5"
        assert element.get("width") is None
        assert [each.get("d") for each in element.iter() if each.get("d")] == ["M 0.12 1 L 2 3"]


def test_a_page_has_the_plan_and_the_dials_a_train_has(tmp_path: Path) -> None:
    out = tmp_path / "r.html"
    assert call("report", "byzantine-sundial-calendar", "-o", out).exit_code == 0
    page = Read(out.read_text(encoding="utf-8"))
    dials = bool(load("byzantine-sundial-calendar").declaration.dials)
    assert len(page.all("figure")) == len(page.all("svg")) == 1 + dials
    assert call("report", "worm", "-o", out, "--force").exit_code == 0
    assert len(Read(out.read_text(encoding="utf-8")).all("svg")) == 1


def test_without_matplotlib_a_page_comes_without_pictures_and_says_what_brings_them(tmp_path: Path) -> None:
    out = tmp_path / "r.html"
    done = without("matplotlib", arguments=["report", "worm", "-o", out])
    assert (done.returncode, "Traceback" in done.stderr) == (0, False)
    page = Read(out.read_text(encoding="utf-8"))
    assert page.all("svg") == []
    assert "pip install 'matplotlib>=3.8'" in page.text
    assert "-1/30" in page.text


def test_the_viewer_stands_in_a_frame_that_cannot_reach_the_page(tmp_path: Path) -> None:
    out = tmp_path / "r.html"
    assert call("report", "worm", "-o", out, "--view").exit_code == 0
    (frame,) = Read(out.read_text(encoding="utf-8")).all("iframe")
    assert "allow-scripts" in frame["sandbox"]
    assert "allow-same-origin" not in frame["sandbox"]
    inner = Read(frame["srcdoc"])
    assert inner.all("canvas") or inner.scripts, "the frame holds a page of its own"


@pytest.mark.parametrize("out", [(), ("-o", "r.md"), ("-o", "r.json")])
def test_a_train_turns_in_a_page_only(out: tuple[str, ...], tmp_path: Path) -> None:
    words = [str(tmp_path / word) if word.startswith("r.") else word for word in out]
    result = call("report", "worm", "--view", *words)
    assert result.exit_code == 2
    assert list(tmp_path.iterdir()) == []


def test_what_only_a_page_has_room_for_changes_no_markdown() -> None:
    train = load("freeth-2008")
    plain = to_markdown([describe_shared_page(collect_report(train))])
    assert "Wheels and their sources" not in plain
    assert to_markdown([describe_shared_page(collect_report(train), [Picture("x", SVG)], "<p>v</p>", ["n"])]) == plain


def test_what_stands_between_backticks_is_code_and_everything_is_escaped() -> None:
    page = to_html([Document("t", ["`a<b` is <i>, and a lone ` stays"], [Section("s", ["`bits` are told."])])])
    assert "<p><code>a&lt;b</code> is &lt;i&gt;, and a lone ` stays</p>" in page
    assert "<p><code>bits</code> are told.</p>" in page
