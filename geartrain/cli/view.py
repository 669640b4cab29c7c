"""`geartrain view`, an animated train in one HTML file, and `geartrain watch`, a live report and animation."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import (
    INTERRUPTED,
    Fast,
    File,
    Force,
    Sink,
    StateName,
    Without,
    exit_code,
    file_name,
    is_sound,
    is_standard,
    load_all,
    option_error,
    sink,
    tell,
)
from geartrain.cli.long_runs import Rate, Restitution, Skip, Steps, TimeRequest, ToothModel, run_in_time
from geartrain.errors import GearTrainError, Problem, QuestionError
from geartrain.numerics.exact import plural

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geartrain.analysis.gear_train import GearTrain
    from geartrain.scene import Scene
    from geartrain.scene.scene_run import TimeRun
    from geartrain.viewer.live_server import LivePages
    from geartrain.viewer.viewer_page import Shown


_MOST_ANGLES = 2_000_000  # angles of all links together, before samples are selected

Other = Annotated[str | None, typer.Argument(help="Second train, shown next to the first.", metavar="FILE2")]
Page = Annotated[
    Path | None,
    typer.Option(
        "--output-file",
        "-o",
        metavar="FILE",
        help="Write the page to FILE (- is standard output); default: NAME.html in the current folder.",
    ),
]
Turns = Annotated[str | None, typer.Option("--turns", help="With --dynamics: revolutions of the driving link to show.")]
Embed = Annotated[
    bool, typer.Option("--embed", help="Write only the animation and three buttons, to embed in another page.")
]
Kiosk = Annotated[bool, typer.Option("--kiosk", help="Write a full-screen page that runs by itself, for a museum.")]


def view(
    file: File,
    other: Other = None,
    out: Page = None,
    state: StateName = None,
    open_it: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False,
    force: Force = False,
    discs: Annotated[bool, typer.Option("--discs", help="Draw wheels as plain discs, without teeth.")] = False,
    dynamics: Annotated[
        bool,
        typer.Option(
            "--dynamics",
            help="Simulate one state in the time domain, with backlash and impacts, and animate the result.",
        ),
    ] = False,
    rate: Rate = None,
    turns: Turns = None,
    skip: Skip = None,
    steps: Steps = None,
    restitution: Restitution = None,
    model: ToothModel = None,
    without: Without = None,
    fast: Fast = None,
    embed: Embed = False,
    kiosk: Kiosk = False,
) -> None:
    """Write an animated train, or two side by side, as one HTML file that needs no server and no network.

    Example: `geartrain view freeth-2021 --open`.
    """
    from geartrain.scene import build_scene

    request = TimeRequest(rate, turns, skip, steps, restitution, model, without, fast)
    _check_request(request, dynamics, other)
    shown = _layout(embed, kiosk, other)
    trains = load_all([file] if other is None else [file, other])
    to = _page_sink(out or file_name("-".join(train.name for train in trains), ".html"), force)
    taken: list[tuple[GearTrain, str | None]] = []
    for train in trains:
        states = train.states or (None,) if state is None else (state,)
        # a simulation, and a page with two trains, show one state
        taken += [(train, each) for each in (states[:1] if dynamics or other is not None else states)]
    runs: list[TimeRun | None] = [None] * len(taken)
    if dynamics:  # of one train, with as many samples as a page can contain
        samples = _MOST_ANGLES // len(trains[0].declaration.links)
        runs = [run_in_time(*each, request.arguments() | {"samples": samples}) for each in taken]
    whole = shown == "page"
    scenes = [build_scene(train, each, run=run, formulas=whole) for (train, each), run in zip(taken, runs, strict=True)]
    _write_page(scenes, to, shown, other is not None, not discs)
    if open_it and to.path is not None and not webbrowser.open(to.path.resolve().as_uri()):
        tell("no browser could be started; open the file manually")
    for run in runs:
        if run is not None and not run.complete:
            tell(f"stopped after {run.turns[-1]:.4g} revolutions; the page shows these revolutions")
            raise typer.Exit(INTERRUPTED)
    raise typer.Exit(exit_code(all(is_sound(train, each) for train, each in taken), to))


def _write_page(scenes: Sequence[Scene], to: Sink, shown: Shown, compare: bool, teeth: bool) -> None:
    from geartrain.viewer.viewer_page import frame_of, page

    data = page(scenes, compare=compare, teeth=teeth, shown=shown).encode("utf-8")
    to.write(data, f": {plural(len(scenes), 'scene')}, {len(data) / 1000:,.0f} kB")
    if shown == "embed" and to.path is not None:
        frame = frame_of(to.path.name, scenes[0].title or scenes[0].name)
        tell(f"copy the file next to your page, and add this element to your page:\n{frame}")


def _layout(embed: bool, kiosk: bool, other: str | None) -> Shown:
    """Return the layout `embed`, `kiosk` or `page`; raise `QuestionError` if `embed` or `kiosk` cannot be used."""
    if embed and kiosk:
        what, why = "--embed and --kiosk are given together", "a page can have only one layout"
        raise option_error("view", what, "omit one of them", why)
    if (embed or kiosk) and other is not None:
        layout = "--embed" if embed else "--kiosk"
        what, why = f"two trains are given with {layout}", f"{layout} shows one train"
        raise option_error(other, what, f"give one train, or omit {layout}", why)
    return "embed" if embed else "kiosk" if kiosk else "page"


def _check_request(request: TimeRequest, dynamics: bool, other: str | None) -> None:
    """Raise `QuestionError` for options of --dynamics without --dynamics, and for --dynamics with two trains."""
    if not dynamics and request != TimeRequest():
        what = "options of --dynamics are given without --dynamics"
        why = "without --dynamics the page shows the kinematics only"
        raise QuestionError(Problem(what, why, "add --dynamics, or omit these options"))
    if dynamics and other is not None:
        why = "two trains on one page share a crank, but each simulation has its own time"
        raise option_error(other, "two trains are given with --dynamics", "write a page for each train", why)


def _page_sink(path: Path, force: bool) -> Sink:
    """Return the destination of a page; raise `QuestionError` for a suffix that browsers do not open as a page."""
    if is_standard(path) or path.suffix.lower() in (".html", ".htm") or path.is_dir():
        return sink(path, force)
    why = f"'{path.suffix}' is not a suffix of an HTML page" if path.suffix else "its name has no suffix"
    fix = "use the suffix .html; pictures and films can be saved from the page"
    raise option_error(str(path), "the page cannot be written", fix, why)


# ---------------------------------------------------------------------------------------------------------------- watch


def watch(
    file: Annotated[str, typer.Argument(help="YAML file to watch.", metavar="FILE")],
    port: Annotated[
        int, typer.Option("--port", min=0, max=65535, help="Port of the local server; 0 selects a free port.")
    ] = 0,
    open_it: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False,
) -> None:
    """Show report and animation side by side in a browser, updated whenever the file is saved; Ctrl-C ends the server.

    The page is served on this machine only. Updates keep the camera, the crank position and the state. Errors in the
    file are displayed above the last valid version.

    Example: `geartrain watch train.yaml --open`.
    """
    from geartrain.viewer.live_server import LiveServer

    path = Path(file)
    if not path.is_file():
        what = f"file '{file}' does not exist"
        fix = "give an existing file; `geartrain init planetary` creates an example"
        raise QuestionError(Problem(what, "only a saved file can be watched", fix))
    server = LiveServer(lambda: _pages(path), lambda: _files(path), port)
    server.refresh()
    tell(server.error or f"{file} is shown at {server.address}; press Ctrl-C to stop")
    if server.error:
        tell(f"the page will be shown at {server.address} when the file is corrected; press Ctrl-C to stop")
    if open_it and not webbrowser.open(server.address):
        tell("no browser could be started; open the address manually")
    server.run(lambda error: tell(error or f"{file} is updated"))


def _pages(path: Path) -> LivePages:
    from geartrain.analysis.gear_train import load
    from geartrain.report.html_page import to_html
    from geartrain.report.train_data import collect_report
    from geartrain.report.train_report import describe_shared_page
    from geartrain.viewer.live_server import LivePages
    from geartrain.viewer.viewer_page import train_page

    train = load(path)
    return LivePages(to_html([describe_shared_page(collect_report(train), [], "", [])]), train_page(train))


def _files(path: Path) -> tuple[Path, ...]:
    """Return a declaration file and all files that it extends; only the file itself if one of them cannot be read."""
    from geartrain.train.declaration_files import files_of

    try:
        return files_of(path)
    except (GearTrainError, OSError):
        return (path,)
