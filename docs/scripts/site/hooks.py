"""What mkdocs does beside its work: gallery, viewers, diagrams, notebooks, names over files, formulas as MathML."""

from __future__ import annotations

import logging
import re
from functools import cache
from pathlib import Path
from typing import Any

import diagrams
import gallery
import markup
import notebooks
import try_page
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page
from mkdocs.utils import get_relative_url
from pymdownx.slugs import slugify

_log = logging.getLogger("mkdocs.hooks")


@cache
def _try_page() -> dict[str, Path]:
    """What try.html loads; nothing where npm or its packages are not at hand, which the log tells and the page too."""
    try:
        return try_page.make()
    except (FileNotFoundError, RuntimeError) as error:
        _log.info("try.html answers nothing in this copy: %s", error)
        return {}


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Anchors as GitHub makes them, so that links work in both places."""
    config.mdx_configs["toc"]["slugify"] = slugify(case="lower")
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Pictures, viewer pages and reports of all trains of the gallery join the site."""
    for name, path in gallery.make().items():
        files.append(File.generated(config, name, abs_src_path=str(path)))
    for name, path in _try_page().items():
        files.append(File.generated(config, name, abs_src_path=str(path)))
    for name, path in diagrams.files().items():
        files.append(File.generated(config, name, abs_src_path=str(path)))
    for name, text in notebooks.pages().items():
        files.append(File.generated(config, name, content=text))
    return files


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """The marks above code blocks become their titles, marked trains frames, tables of the gallery cards."""
    if page.file.src_uri == "try.md" and not _try_page():
        markdown = re.sub(r"^<(link|script) .*\btry/try\..*\n", "", markdown, flags=re.MULTILINE)
    return gallery.with_frames(gallery.with_cards(markup.with_titles(markdown)))


def on_page_content(html: str, page: Page, **_: Any) -> str:
    """Formulas become MathML, and marked pictures what a reader can drag."""
    return diagrams.with_diagrams(markup.with_mathml(html), get_relative_url("", page.url))
