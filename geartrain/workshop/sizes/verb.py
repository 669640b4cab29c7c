"""Commands `geartrain optimise` and `geartrain mesh --objective`: find optimal sizes of triangular teeth."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer

from geartrain.cli.common import (
    GOOD,
    VERDICT,
    File,
    FirstState,
    Force,
    Json,
    Out,
    Sink,
    check_distinct_outputs,
    draw,
    emit,
    give,
    option_error,
    picture_sink,
    sink,
)
from geartrain.cli.long_runs import progress
from geartrain.cli.option_values import Theme, at_option, decimal, quantity
from geartrain.cli.pair_options import COUNTS, PairRequest, read_form, read_pair_friction
from geartrain.errors import GearTrainError, Problem
from geartrain.teeth.triangular.triangular_form import CLEARANCES, Triangular

if TYPE_CHECKING:
    from geartrain.workshop.sizes.size_design import SizeLimit, ToothSizes
    from geartrain.workshop.sizes.size_search import ProbabilityLimit


_YAML = (".yaml", ".yml")
_DESIGNS = {1: 60, 2: 500, 3: 900}
"""Approximate number of designs evaluated for each objective, keyed by number of free parameters. It is used for the
progress bar.
"""

_DIMENSIONS = {"loss": "fraction", "error": "angle", "backlash": "angle"}
"""Physical quantity of each limit (a fraction or an angle), keyed by name of the limit. Limits that are not listed are
plain numbers.
"""


def run(
    file: File,
    output: Annotated[str, typer.Option("--of", help="Output or link for which the objective is optimised.")],
    best: Annotated[
        str,
        typer.Option(
            "--objective", help="Objective: minimise loss, error or impact, or maximise the jam margin (jam)."
        ),
    ] = "loss",
    free: Annotated[
        list[str] | None,
        typer.Option(
            "--free",
            help="Parameter to vary, as NAME or NAME=LOW:HIGH. Names: radii (ratio of radii divided by ratio of tooth "
            "counts), window (position of the clearance factor between its limits: 0 = lower, 1 = upper), half_angle "
            "(half the angle between the flanks of a tooth). May be repeated; default: radii.",
        ),
    ] = None,
    within: Annotated[
        list[str] | None,
        typer.Option(
            "--within",
            help="Limit NAME=LIMIT for each pair: loss, error, impact, jam, window_width or backlash; may be repeated.",
        ),
    ] = None,
    state: FirstState = None,
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot", help="Write a plot of the objective of each pair, declared and optimised, to this file."
        ),
    ] = None,
    json: Json = False,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Optimise the triangular teeth of a train, first pair by pair, then together; -o FILE.yaml writes a declaration.

    Example: `geartrain optimise moon-triangular --of moon --objective jam --free window`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.workshop.sizes.tooth_sizes_report import describe_train_sizes
    from geartrain.workshop.sizes.train_size_search import find_train_sizes

    to = sink(out, force, (".md", ".html", ".json", *_YAML))
    picture = picture_sink(plot, force, theme)
    check_distinct_outputs(to, picture)
    ranges, limits = read_free(free or ()), read_limits(within or ())
    train = load(file)
    # an estimate: the number of evaluations is unknown before the search
    with progress("optimise", 10 * len(train.declaration.gears), patience=2) as bar:
        found = find_train_sizes(train, output, best, ranges, limits, state, bar.advance)
    if plot is not None:
        from geartrain.workshop.sizes.tooth_sizes_plot import train_sizes_figure

        draw(train_sizes_figure(found), picture)
    if to.suffix in _YAML:
        _declare(found.declaration, file, to)
        to = Sink()
    give(to, json, lambda: found, lambda: [describe_train_sizes(found)])
    raise typer.Exit(GOOD if all(pair.outlines.turns for pair in found.pairs) else VERDICT)


def _declare(declaration: Mapping[str, Any], file: str, to: Sink) -> None:
    """Write a declaration that extends the given train by its name, or by its path if it is a file."""
    from geartrain.train.yaml_nodes import as_yaml

    parent = file
    if to.path is not None and Path(file).exists():
        parent = os.path.relpath(file, to.path.parent).replace(os.sep, "/")
    emit(as_yaml({**declaration, "extends": parent}), to)


# ----------------------------------------------------------------------------------------------- mesh --objective


@dataclass(frozen=True)
class SizeQuestion:
    """Options of `--objective`: one or two objectives, free parameters, limits on designs, and cutting errors."""

    best: str | None
    free: tuple[str, ...]
    within: tuple[str, ...]
    errors: tuple[str, ...]

    def check(self, others: Mapping[str, object]) -> None:
        """Raise an error if `others` are given with --objective, or options of the search without it."""
        what, fix = "the option cannot be combined with --objective", "omit one of the two options"
        refused = others
        if self.best is None:
            what, fix = "the option applies only to a search with --objective", "give --objective too"
            refused = {"--free": self.free, "--within": self.within, "--cutting": self.errors}
        for option, given in refused.items():
            if given:
                raise option_error(option, what, fix)

    def answer(self, pair: PairRequest, to: Sink, picture: Sink, json: bool) -> NoReturn:
        """Write the best sizes as a report, as data and as a plot, and end the command."""
        from geartrain.workshop.sizes.best_sizes import find_tooth_sizes
        from geartrain.workshop.sizes.tooth_sizes_report import describe_tooth_sizes

        aims = tuple(part.strip() for part in (self.best or "").split(","))
        free, limits = read_free(self.free), read_limits([text for text in self.within if not _is_probability(text)])
        probability = self._probability()
        work = _DESIGNS.get(len(free), 900) * len(aims)
        with progress("best sizes", work, patience=2) as bar:
            found = find_tooth_sizes(_start(pair), aims, free, limits, probability, bar.advance)
        give(to, json, lambda: found, lambda: [describe_tooth_sizes(found)])
        if picture.path is not None:
            from geartrain.workshop.sizes.tooth_sizes_plot import tooth_sizes_figure

            draw(tooth_sizes_figure(found), picture)
        raise typer.Exit(GOOD if found.outlines.turns else VERDICT)

    def _probability(self) -> ProbabilityLimit | None:
        """Return the limit on the probability that a pair jams or clashes, or None if it is not given."""
        from geartrain.workshop.sizes.size_search import ProbabilityLimit

        given = [text.partition("=")[2] for text in self.within if _is_probability(text)]
        if bool(given) != bool(self.errors):
            if given:
                raise option_error(
                    "--within", "the limit `stops` needs cutting errors", "give --cutting 'pitch_deviation=1 %' too"
                )
            raise option_error("--cutting", "no limit depends on cutting errors", "give --within stops=5% too")
        if not given:
            return None
        from geartrain.workshop.cutting.declared_errors import read_error_overrides
        from geartrain.workshop.sizes.size_search import PairTrials

        # the strictest of several limits applies
        bound = min(quantity("--within", text, "fraction", plain=True, minimum="0") for text in given)
        return ProbabilityLimit(bound, PairTrials(read_error_overrides(self.errors)).stops)


def _is_probability(text: str) -> bool:
    """Return True if a limit applies to the probability of a jam or clash, which requires trials."""
    return text.partition("=")[0].strip() == "stops"


def _start(pair: PairRequest) -> ToothSizes:
    """Return the design that the options describe, by default with a clearance factor midway between the limits."""
    from geartrain.workshop.sizes.size_design import ToothSizes

    friction = read_pair_friction(pair.friction).number("--objective")
    for name in pair.own:
        if name in CLEARANCES and name != "window":
            why = "the clearance window depends on the radii, so a fixed clearance could be outside it"
            what = f"{name} cannot be combined with --objective"
            raise GearTrainError(Problem(what, why, "give -p window=0.5", f"-p {name}"))
    shape = {name: text for name, text in pair.own.items() if name != "window"}
    # the radii do not depend on the clearance, so any excess will do, even if the pair has no clearance window
    unplaced, placed = read_form(Triangular, {**shape, "excess": "1e-6"}), read_form(Triangular, pair.own)
    assert isinstance(unplaced, Triangular)
    assert isinstance(placed, Triangular)
    assert placed.window is not None
    z1, z2 = pair.teeth
    try:
        sizes = unplaced.sizes(z1, z2, ring=2 if pair.internal else 0)
    except GearTrainError as error:
        raise at_option(error, COUNTS) from None
    radii = sizes.R2 / sizes.R1 * z1 / z2
    return ToothSizes(
        pair.teeth, radii, float(placed.window.value), sizes.half_angles, friction, pair.driver, sizes.ring
    )


def read_free(given: Sequence[str]) -> Mapping[str, tuple[float, float] | None]:
    """Return the bounds of free parameters (None: usual bounds) from texts NAME or NAME=LOW:HIGH; default: radii."""
    found: dict[str, tuple[float, float] | None] = {}
    for text in given or ("radii",):
        name, equals, rest = text.partition("=")
        low, colon, high = rest.partition(":")
        if bool(equals) != bool(colon):
            raise option_error("--free", f"'{text}' is not a free parameter", "write it as NAME or NAME=LOW:HIGH")
        name = name.strip()
        found[name] = (_bound(name, low), _bound(name, high)) if equals else None
    return found


def _bound(name: str, text: str) -> float:
    if name == "half_angle":
        return quantity("--free", text.strip(), "angle")
    return decimal("--free", text, "bound", "0.9")


def read_limits(given: Sequence[str]) -> list[SizeLimit]:
    """Return limits parsed from texts NAME=LIMIT. Each limit is a maximum or a minimum, depending on the quantity."""
    from geartrain.workshop.sizes.size_design import SizeLimit

    found = []
    for text in given:
        name, equals, rest = text.partition("=")
        name = name.strip()
        if not equals or name not in SizeLimit.FIGURES:
            fix = f"write it as NAME=LIMIT, with one of {', '.join(SizeLimit.FIGURES)}"
            raise option_error("--within", f"'{text}' is not a limit", fix)
        dimension, text = _DIMENSIONS.get(name), rest.strip()
        if dimension is None:
            bound = decimal("--within", text, "limit", "0.02")
        else:
            bound = quantity("--within", text, dimension, plain=dimension == "fraction", minimum="0")
        found.append(SizeLimit(name, bound))
    return found
