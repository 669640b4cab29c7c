"""Pages as GitHub shows them, made ready for mkdocs."""

from __future__ import annotations

import re
from html import unescape

from latex2mathml.converter import convert

_FILE = re.compile(r"^<!-- file: (.*?) -->\n((?:<!-- .* -->\n)*)```(\w+)$", re.MULTILINE)
_SHOW = re.compile(r"^<!-- show: .*? -->\n", re.MULTILINE)
_FORMULA = re.compile(r'<(span|div) class="arithmatex">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)
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
    return f'<div class="formula">{convert(_TAG.sub("", source), display="block")}{number}</div>'
