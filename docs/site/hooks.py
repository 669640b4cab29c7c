"""What mkdocs does beside its work: gallery, viewer pages, notebooks, names over files, formulas without scripts."""

from __future__ import annotations

from typing import Any

import gallery
import markup
import notebooks
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from pymdownx.slugs import slugify


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Anchors as GitHub makes them, so that links work in both places."""
    config.mdx_configs["toc"]["slugify"] = slugify(case="lower")
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Pictures, viewer pages and reports of all trains of the gallery join the site."""
    for name, path in gallery.make().items():
        files.append(File.generated(config, name, abs_src_path=str(path)))
    for name, text in notebooks.pages().items():
        files.append(File.generated(config, name, content=text))
    return files


def on_page_markdown(markdown: str, **_: Any) -> str:
    """The marks above code blocks become their titles, tables of the gallery become cards."""
    return gallery.with_cards(markup.with_titles(markdown))


def on_page_content(html: str, **_: Any) -> str:
    """Formulas become MathML."""
    return markup.with_mathml(html)
