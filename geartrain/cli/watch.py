"""`geartrain watch`: report and turning train in the browser, made anew each time the file is saved."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import tell
from geartrain.errors import GearTrainError, Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.viewer.live_server import LivePages


def run(
    file: Annotated[str, typer.Argument(help="A YAML file.", metavar="{FILE}")],
    port: Annotated[int, typer.Option("--port", min=0, max=65535, help="Where it is served; 0 takes a free one.")] = 0,
    open_it: Annotated[bool, typer.Option("--open", help="Show it in the browser.")] = False,
) -> None:
    """Show report and turning train side by side, and again each time the file is saved; Ctrl-C ends it.

    The page is served on this machine alone, and keeps camera, crank and state. What is wrong with the file stands
    above what was shown last.
    """
    from geartrain.viewer.live_server import LiveServer

    path = Path(file)
    if not path.is_file():
        what, fix = f"there is no file '{file}'", "give a file, such as one that `geartrain init planetary` writes"
        raise QuestionError(Problem(what, "a page can follow only what is saved", fix))
    server = LiveServer(lambda: _pages(path), lambda: _files(path), port)
    server.refresh()
    tell(server.error or f"{file} is shown at {server.address} until Ctrl-C ends it")
    if server.error:
        tell(f"it is shown at {server.address} once that is mended, until Ctrl-C ends it")
    if open_it and not webbrowser.open(server.address):
        tell("no browser could be started here; open the address by hand")
    server.run(lambda error: tell(error or f"{file} is shown anew"))


def _pages(path: Path) -> LivePages:
    from geartrain.analysis.gear_train import load
    from geartrain.report.html_page import to_html
    from geartrain.report.train_data import collect_report
    from geartrain.report.train_report import describe_shared_page
    from geartrain.viewer import train_page
    from geartrain.viewer.live_server import LivePages

    train = load(path)
    return LivePages(to_html([describe_shared_page(collect_report(train), [], "", [])]), train_page(train))


def _files(path: Path) -> tuple[Path, ...]:
    """The file and those that it extends; the file alone while that cannot be read."""
    from geartrain.train.declaration_files import files_of

    try:
        return files_of(path)
    except (GearTrainError, OSError):
        return (path,)
