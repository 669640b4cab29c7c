"""Eigenfrequencies and modes of a train whose teeth yield, while all its drive flanks touch."""

from __future__ import annotations

import html
from dataclasses import dataclass
from math import tau
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.labelled_array import labelled_array
from geartrain.numerics.results import Result

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.labelled_array import LabelledArray
    from geartrain.simulation.contacts.yielding_train import YieldingTrain


@dataclass(frozen=True)
class VibrationModes(Result):
    """How a train swings about contact: what solves K phi = w^2 M phi, speed ratios at their means.

    Attributes
    ----------
    train : str
        Its name.
    frequencies : array of float, (mode,)
        Rising [Hz]; 0 where the train turns as a whole and nothing prescribes its speed.
    damping : array of float, (mode,)
        Ratio to the critical, of each mode by itself; 0 at 0 Hz.
    shapes : LabelledArray, (link, mode)
        Angles of links, the greatest of each mode 1.
    stiffness : mapping of str to float
        Of each pair, on its driven side [N m/rad].
    notes : tuple of str
        What is left out.
    assumed : tuple of str
        What nothing declares and was estimated.

    See Also
    --------
    geartrain.simulation.find_vibration_modes : gives these.
    """

    train: str
    frequencies: Floats
    damping: Floats
    shapes: LabelledArray
    stiffness: dict[str, float]
    notes: tuple[str, ...]
    assumed: tuple[str, ...]

    def _repr_html_(self) -> str:
        links = self.shapes.labels[0]
        head = "".join(f"<th>{html.escape(each)}</th>" for each in ("mode", "Hz", "damping", *links))
        rows = "".join(
            f"<tr><td>{at + 1}</td><td>{frequency:.6g}</td><td>{damping:.4g}</td>"
            + "".join(f"<td>{angle:.4g}</td>" for angle in self.shapes.values[:, at])
            + "</tr>"
            for at, (frequency, damping) in enumerate(zip(self.frequencies, self.damping, strict=True))
        )
        return f"<p>{html.escape(self.train)}: angles of links in each mode</p><table><tr>{head}</tr>{rows}</table>"


def find_modes(of: YieldingTrain) -> VibrationModes:
    """Of a train in one case."""
    squares, modes = of.vibration
    speeds = np.sqrt(squares)
    losses = np.einsum("im,ij,jm->m", modes, of.matrices[1], modes)
    damping = np.divide(losses, 2 * speeds, out=np.zeros_like(speeds), where=speeds > 0)
    shapes = of.speeds[:, of.free] @ modes
    for column in shapes.T:
        column /= column[np.argmax(np.abs(column))]
    shapes += 0.0  # no zero is negative
    names = [str(at + 1) for at in range(len(speeds))]
    stiffness = {pair.name: float(k) for pair, k in zip(of.model.pairs, of.yields.stiffness, strict=True)}
    frequencies = speeds / tau
    frequencies.flags.writeable = damping.flags.writeable = False
    links = of.problem.system.links
    return VibrationModes(
        of.train.name,
        frequencies,
        damping,
        labelled_array(shapes, link=links, mode=names),
        stiffness,
        of.notes,
        of.assumed,
    )
