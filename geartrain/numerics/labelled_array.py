"""Read-only arrays with named axes and labelled positions."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

from numpy.typing import NDArray

from geartrain.numerics.results import Result, Tabular

_FEW = 4  # labels of the first axis in a summary
_MOST = 40  # labels of an axis that are shown whole


@dataclass(frozen=True, slots=True)
class LabelledArray(Tabular, Result):
    """Read-only array with a name for every axis and a label for every position on an axis.

    `array["moon"]` or `array["moon", "0"]` returns the value or sub-array at these labels. An unknown label raises
    `KeyError`.

    Examples
    --------
    >>> import geartrain
    >>> speeds = geartrain.load("planetary-24-18-60").kinematics.floats(inputs={"sun": [7.0, 14.0]}).speeds
    >>> speeds.axes, speeds["carrier"].round(9).tolist()
    (('link', 'case'), [2.0, 4.0])
    """

    KEYS = ("axes", "labels", "values")

    values: NDArray[Any]
    """Values of the array, read-only, with one dimension for each axis."""
    axes: tuple[str, ...]
    """Name of each axis, such as ("link", "case")."""
    labels: tuple[tuple[str, ...], ...]
    """Labels of the positions on each axis."""

    def __post_init__(self) -> None:
        if self.values.shape != tuple(len(names) for names in self.labels):
            raise ValueError(f"shape {self.values.shape} does not fit the labels of {self.axes}")
        # the instance is frozen, and so must its array be
        self.values.flags.writeable = False

    def __getitem__(self, key: str | tuple[str, ...]) -> Any:
        """Return the value or sub-array at the given labels, one for each axis in order."""
        keys = (key,) if isinstance(key, str) else key
        return self.values[tuple(self._position(axis, label) for axis, label in enumerate(keys))]

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table: one for each label of the first axis, with a row for each label of the second axis.

        A single axis becomes two columns, labels and values; three or more axes become a row for each value.
        """
        if len(self.axes) == 1:
            return {self.axes[0]: self.labels[0], "value": self.values.tolist()}
        if len(self.axes) == 2:
            return {self.axes[1]: self.labels[1], **dict(zip(self.labels[0], self.values.tolist(), strict=True))}
        places = [*product(*self.labels)]
        axes = {name: [place[at] for place in places] for at, name in enumerate(self.axes)}
        return {**axes, "value": self.values.ravel().tolist()}

    def _position(self, axis: int, label: str) -> int:
        try:
            return self.labels[axis].index(label)
        except ValueError:
            raise KeyError(f"no {self.axes[axis]} '{label}'") from None

    def _summary(self) -> str:
        shape = " x ".join(f"{len(names)} {axis}" for axis, names in zip(self.axes, self.labels, strict=True))
        return f"{shape}: {', '.join(self.labels[0][:_FEW]) if self.labels else ''}" + (
            ", ..." if self.labels and len(self.labels[0]) > _FEW else ""
        )

    def _meaning(self, column: str) -> str:
        if column in self.axes:
            return f"Label on the axis {column}."
        return "Value at the labels." if column == "value" else f"Value at {self.axes[0]} {column}."

    def __str__(self) -> str:
        """Return the values in the format of numpy, with the names and labels of the axes."""
        labels = ", ".join(_names(each) for each in self.labels)
        return f"LabelledArray(values={self.values!r}, axes={self.axes!r}, labels=({labels}))"

    def _repr_html_(self) -> str:
        if len(self.axes) != 2:
            return f"<pre>{self.values!r}</pre>"
        shown = [_shown(len(each)) for each in self.labels]
        head = "".join(f"<th>{_label(self.labels[1], at)}</th>" for at in shown[1])
        rows = "".join(
            f"<tr><th>{_label(self.labels[0], row)}</th>"
            + "".join(f"<td>{'…' if None in (row, at) else self.values[row, at]}</td>" for at in shown[1])
            + "</tr>"
            for row in shown[0]
        )
        return f"<table><tr><th></th>{head}</tr>{rows}</table>"


def _shown(count: int) -> list[int | None]:
    """Return the positions shown of an axis with `count` labels; None marks the positions that are omitted."""
    if count <= _MOST:
        return list(range(count))
    return [*range(_MOST // 2), None, *range(count - _MOST // 2, count)]


def _label(names: Sequence[str], at: int | None) -> str:
    return "…" if at is None else html.escape(names[at])


def _names(names: Sequence[str]) -> str:
    if len(names) <= _MOST:
        return repr(tuple(names))
    return f"({', '.join('...' if at is None else repr(names[at]) for at in _shown(len(names)))})"


def labelled_array(values: NDArray[Any], **axes: Sequence[str]) -> LabelledArray:
    """Create a `LabelledArray` with one keyword per axis: `labelled_array(speeds, link=names, case=cases)`."""
    return LabelledArray(values, tuple(axes), tuple(tuple(names) for names in axes.values()))
