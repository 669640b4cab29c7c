"""Text of users as text in Markdown: no HTML, and no links that could run a script."""

from __future__ import annotations

import re

_TAG = re.compile(r"<(?=[A-Za-z/!?])")
_ENTITY = re.compile(r"&(?=#?\w+;)")
_LINK = re.compile(r"\](?=(?:\(\s*<?([^)>]*)|:\s*<?(\S*)))")
"""Where the address of an inline link or image, or that of a reference definition, follows."""
_IGNORED = re.compile(r"[\x00-\x20\\]")
"""What Markdown or a browser leaves out of an address: escapes, blanks, control characters."""
_SCHEME = re.compile(r"([a-z][a-z0-9+.-]*):", re.IGNORECASE)
_FOLLOWED = {"http", "https", "mailto"}


def markdown_text(text: str) -> str:
    """Text without HTML, and without links other than relative ones and those of http, https and mailto.

    >>> markdown_text("<b> [worn](JavaScript:alert(1)), see [the paper](https://example.org)")
    '&lt;b> [worn]\\\\(JavaScript:alert(1)), see [the paper](https://example.org)'
    """
    return _LINK.sub(_bracket, _TAG.sub("&lt;", _ENTITY.sub("&amp;", text)))


def _bracket(found: re.Match[str]) -> str:
    """The bracket before an address, with a backslash after it where the address must not be followed."""
    scheme = _SCHEME.match(_IGNORED.sub("", found[1] or found[2] or ""))
    return "]" if scheme is None or scheme[1].lower() in _FOLLOWED else "]\\"
