"""The option of commands that draw; in a module of its own, so that other commands load no colours."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.scene.palette import ThemeName

Theme = Annotated[ThemeName, typer.Option("--theme", help="Colours of pictures: light, dark, or print without colour.")]
