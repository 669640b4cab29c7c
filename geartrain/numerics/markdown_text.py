"""Conversion of user text to literal Markdown without HTML, and without links that could run a script."""

from __future__ import annotations

import re

_TAG = re.compile(r"<(?=[A-Za-z/!?])")
_ENTITY = re.compile(r"&(?=#?\w+;)")
_LINK = re.compile(r"\](?=(?:\(\s*<?([^)>]*)|:\s*<?(\S*)))")
"""Pattern of the closing bracket before the address of an inline link, an image or a reference definition."""
_IGNORED = re.compile(r"[\x00-\x20\\]")
"""Pattern of characters that Markdown or a browser ignores in an address: backslashes, blanks, control characters."""
_SCHEME = re.compile(r"([a-z][a-z0-9+.-]*):", re.IGNORECASE)
_FOLLOWED = {"http", "https", "mailto"}


def markdown_text(text: str) -> str:
    r"""Return the text with HTML and links escaped, except links that are relative or use http, https or mailto.

    >>> markdown_text("<b> [worn](JavaScript:alert(1)), see [the paper](https://example.org)")
    '&lt;b> [worn]\\(JavaScript:alert(1)), see [the paper](https://example.org)'
    """
    return _LINK.sub(_bracket, _TAG.sub("&lt;", _ENTITY.sub("&amp;", text)))


def _bracket(found: re.Match[str]) -> str:
    """Return the bracket before an address; it is preceded by a backslash if the address is not allowed."""
    scheme = _SCHEME.match(_IGNORED.sub("", found[1] or found[2] or ""))
    return "]" if scheme is None or scheme[1].lower() in _FOLLOWED else "]\\"
