"""Trees of a document in every form: as lists in Markdown, by strokes on a terminal, escaped on a page."""

from __future__ import annotations

import pytest

from geartrain.report import Branch, Document, Section, to_html, to_markdown, to_text
from geartrain.report.document import SceneText

EVIL = "<script>alert(1)</script>"
BRANCHES = [Branch("stem", [Branch(EVIL, [Branch(SceneText("end", 2))]), Branch("other")])]
DOCUMENT = Document("Title", (), [Section("Tree", ["Said."], branches=BRANCHES)])


def test_a_tree_is_a_list_of_lists_in_markdown() -> None:
    text = to_markdown([DOCUMENT])
    assert "- stem\n  - &lt;script>alert(1)&lt;/script>\n    - end\n  - other\n\n" in f"{text}\n"


def test_a_tree_is_joined_by_strokes_on_a_terminal() -> None:
    text = to_text([DOCUMENT])
    assert f"stem\n├── {EVIL}\n│   └── end\n└── other" in text


def test_a_tree_on_a_page_is_escaped_and_its_scenes_are_marked() -> None:
    pytest.importorskip("jinja2")
    page = to_html([DOCUMENT])
    assert EVIL not in page
    assert '<span data-scene="2">end</span>' in page
    assert page.count("<ul>") == page.count("</ul>")
    assert page.count("<li>") == page.count("</li>")
