"""How far pointers stray when wheels are cut by hand: along the way, and how often how far."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from textwrap import shorten
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from geartrain.drawing.style import BLACK, BLUE, GREY, RED, SMALL, TEXT, WIDTH, Axes, Figure, MaxNLocator, Patch, plain
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


_Given = TypeVar("_Given")
PERCENTS = (2.5, 25.0, 50.0, 75.0, 97.5)
_ROW = 2.3  # inches of a panel
_POINTERS = 12  # drawn: those that stray most
_SHARES = ("every trial", "95 % of the trials", "50 %")  # of the trials in a band
_SHADES = (0.12, 0.22, 0.26)  # opacities of the bands, which lie on each other
_DASHES: Any = (0, (4, 1.2))
_STILL = 90  # letters of the names of pointers that never stray
_BINS = (12, 60)  # fewest and most of a histogram


@dataclass(frozen=True, slots=True)
class ErrorBands:
    """What part of the trials stays within what error, over the turns of the input: arrays (positions,).

    turns             of the input
    least, greatest   error of any trial (deg)
    percentiles       2.5, 25, 50, 75 and 97.5 percent of the trials are below (deg), (5, positions)
    trials            that run; those that jam point nowhere
    example           error of one trial (deg), or None
    """

    turns: Floats
    least: Floats
    greatest: Floats
    percentiles: Floats
    trials: int
    example: Floats | None = None

    @classmethod
    def of(cls, turns: ArrayLike, errors: ArrayLike) -> ErrorBands:
        """From the errors (deg) of every trial, (trials, positions); trials with a NaN are left out.

        Raises `QuestionError` where no trial is left, or where positions and turns are not as many.
        """
        places, table = np.asarray(turns, dtype=float), np.atleast_2d(np.asarray(errors, dtype=float))
        table = table[np.isfinite(table).all(axis=1)]
        if table.shape[1:] != places.shape or not table.size:
            raise _nothing(f"errors of shape {table.shape} at {places.size} positions")
        levels = np.percentile(table, PERCENTS, axis=0)
        return cls(places, table.min(axis=0), table.max(axis=0), levels, len(table), table[0])


def pointer_error_figure(pointers: Mapping[str, ErrorBands], lead: str = "the input") -> Figure:
    """Of each pointer: median, the middle 50 and 95 percent, and the extremes of its error over the turns of `lead`.

    The thin dashed line is one trial. Raises `QuestionError` where there is none to draw.
    """
    shown, left = _most(pointers, lambda bands: float(np.ptp(bands.percentiles)))
    spans = {float(np.ptp(bands.turns)) for bands in shown.values()}
    figure, panels = _panels(shown, sharex=len(spans) <= 1)  # each over a turn of its own pointer
    for axes, (name, bands) in zip(panels, shown.items(), strict=True):
        low, lower, middle, upper, high = bands.percentiles
        for each in zip((bands.least, low, lower), (bands.greatest, high, upper), _SHADES, _SHARES, strict=True):
            _between(axes, bands.turns, *each)
        if bands.example is not None:
            axes.plot(
                bands.turns, bands.example, color=RED, linewidth=0.9, linestyle=_DASHES, label="one of them", gid="one"
            )
        axes.plot(bands.turns, middle, color=BLACK, linewidth=1.6, label="median", gid="median")
        axes.axhline(0.0, color=GREY, linewidth=0.8, linestyle="-.")
        axes.set_ylabel(f"{name}\nerror (deg)", fontsize=TEXT)
        axes.set_xlim(bands.turns[0], bands.turns[-1])
    panels[-1].set_xlabel(f"turns of {lead}{left}", fontsize=TEXT)
    _legend(figure, panels[0])
    return figure


def histogram_figure(errors: Mapping[str, ArrayLike], note: str = "") -> Figure:
    """How often each pointer is how far off (deg), with the percentiles 2.5, 25, 50, 75 and 97.5 as lines.

    errors   pointer -> its error in every trial; NaN, of trials that jam, is left out
    note     stands under the last panel, such as where in the cycle the errors are
    Raises `QuestionError` where there is nothing to draw.
    """
    shown, left = _most(errors, _spread)
    figure, panels = _panels(shown)
    for axes, (name, given) in zip(panels, shown.items(), strict=True):
        values = np.asarray(given, dtype=float).ravel()
        values = values[np.isfinite(values)]
        if not values.size:
            raise _nothing(f"'{name}' has no trial that runs")
        axes.hist(values, bins=_edges(values).tolist(), color=BLUE, alpha=0.45, edgecolor="white", linewidth=0.4)
        axes.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=(1, 2, 5, 10), integer=True))
        _percentiles(axes, values)
        axes.set_ylabel(f"{name}\ntrials of {values.size:,}", fontsize=TEXT)
    panels[-1].set_xlabel(f"error (deg){'; ' if note else ''}{note}{left}", fontsize=TEXT)
    return figure


def _most(what: Mapping[str, _Given], spread: Callable[[_Given], float]) -> tuple[dict[str, _Given], str]:
    """The pointers that stray most, in the order given, and words on the others; none that never strays."""
    straying = [name for name in what if spread(what[name]) > 0] or list(what)
    names = set(sorted(straying, key=lambda name: -spread(what[name]))[:_POINTERS])
    left, still = len(straying) - len(names), [name for name in what if name not in straying]
    words = f"\n{left} pointers that stray less are left out: name them with --output" if left else ""
    if still:
        words += f"\nnever astray: {shorten(', '.join(still), _STILL, placeholder=' ...')}"
    return {name: each for name, each in what.items() if name in names}, words


def _spread(given: ArrayLike) -> float:
    """Of the trials that run; 0 where none does."""
    values = np.asarray(given, dtype=float)
    values = values[np.isfinite(values)]
    return float(np.ptp(values)) if values.size else 0.0


def _percentiles(axes: Axes, values: Floats) -> None:
    low, lower, middle, upper, high = np.percentile(values, PERCENTS)
    axes.axvline(middle, color=BLACK, linewidth=1.8, label=f"median {middle:.3g}", gid="median")
    for ends, style, share in (((lower, upper), (0, (6, 2)), 50), ((low, high), (0, (2, 1.5)), 95)):
        words = f"{share} %: {ends[0]:.3g} to {ends[1]:.3g}"
        for at, end in enumerate(ends):
            axes.axvline(end, color=RED, linewidth=1.5, linestyle=style, label=None if at else words, gid=f"{share} %")
    axes.legend(loc="lower right", bbox_to_anchor=(1, 1), borderpad=0, frameon=False, fontsize=SMALL, ncols=3)


def _edges(values: Floats) -> Floats:
    """Bins by the rule of Freedman and Diaconis, 2 IQR / n^(1/3) wide, within bounds; around a single value, some."""
    low, high = float(values.min()), float(values.max())
    if high - low <= 1e-12 * max(abs(low), abs(high)):  # bins narrower than rounding would be empty or endless
        half = max(abs(low), 1e-9) * 0.1
        return np.linspace(low - half, high + half, _BINS[0] + 1)
    middle = float(np.subtract(*np.percentile(values, (75, 25))))
    width = 2 * middle / values.size ** (1 / 3)
    bins = _BINS[1] if width <= 0 else int(np.clip((high - low) / width, *_BINS))
    return np.linspace(low, high, bins + 1)


def _panels(what: Mapping[str, Any], sharex: bool = False) -> tuple[Figure, Sequence[Axes]]:
    if not what:
        raise _nothing("no pointer is given")
    figure = Figure(figsize=(WIDTH, 1.3 + _ROW * len(what)), dpi=100, layout="constrained")
    panels = list(figure.subplots(len(what), 1, sharex=sharex, squeeze=False)[:, 0])
    for axes in panels:
        plain(axes)
    return figure, panels


def _between(axes: Axes, x: Floats, low: Floats, high: Floats, alpha: float, label: str) -> None:
    axes.fill_between(x, low, high, color=BLUE, alpha=alpha, linewidth=0, gid=label)


def _bands_key() -> list[Patch]:
    """Bands as they are seen: each lies on those that are wider."""
    through = np.cumprod([1 - shade for shade in _SHADES])
    return [
        Patch(color=BLUE, alpha=1 - float(left), linewidth=0, label=label)
        for left, label in zip(through, _SHARES, strict=True)
    ]


def _legend(figure: Figure, axes: Axes) -> None:
    handles = [*_bands_key(), *axes.get_legend_handles_labels()[0]]
    figure.legend(handles=handles, loc="outside lower left", ncols=5, fontsize=SMALL, frameon=False)


def _nothing(why: str) -> QuestionError:
    return QuestionError(Problem("there is no error to draw", why, "give trials that turn, and one pointer or more"))
