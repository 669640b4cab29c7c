"""Pages as GitHub shows them, made ready for mkdocs."""

from __future__ import annotations

import re
from html import unescape

from latex2mathml.converter import convert

_FILE = re.compile(r"^<!-- file: (.*?) -->\n((?:<!-- .* -->\n)*)```(\w+)$", re.MULTILINE)
_SHOW = re.compile(r"^<!-- show: .*? -->\n", re.MULTILINE)
_FORMULA = re.compile(r'<(span|div) class="arithmatex">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)
_OPEN, _CLOSE = ("{", r"\left", r"\begin"), ("}", r"\right", r"\end")
_MARK = re.compile(r"\\[{}]|[{}]|\\(?:left|right|begin|end)(?![a-z])|\\qquad|,\s*\\quad")
_ROWS = re.compile(r"</math><math[^>]*>")  # between statements, which are rows of one formula
_TAG = re.compile(r"\\tag\{(.*?)\}")


def with_titles(markdown: str) -> str:
    """`<!-- file: NAME -->` above a block as the block's title; other marks go."""
    return _SHOW.sub("", _FILE.sub(r'\2```\3 title="\1"', markdown))


def with_mathml(html: str) -> str:
    """Formulas that the extension arithmatex has marked, as MathML, which browsers show without any script."""
    return _FORMULA.sub(_formula, html)


def _formula(found: re.Match[str]) -> str:
    source = unescape(found[2]).replace(r"\arg", r"\operatorname{arg}")
    if found[1] == "span":
        return convert(source)
    tag = _TAG.search(source)
    number = f'<span class="number">({tag[1]})</span>' if tag else ""
    statements = (convert(each, display="block") for each in _statements(_TAG.sub("", source)))
    return f'<div class="formula">{_ROWS.sub("", "".join(statements))}{number}</div>'


def _statements(source: str) -> list[str]:
    """The statements of a formula, which may stand below each other where a line is too short for all."""
    depth, start, found = 0, 0, []
    for mark in _MARK.finditer(source):
        depth += 1 if mark[0] in _OPEN else -1 if mark[0] in _CLOSE else 0
        if not depth and "quad" in mark[0]:
            found.append(source[start : mark.start()] + ("," if mark[0].startswith(",") else ""))
            start = mark.end()
    return [*found, source[start:]]
