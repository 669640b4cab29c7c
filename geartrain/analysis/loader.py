"""From a path, a shipped name, text or plain data to a train that answers."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from geartrain.analysis.gear_train import GearTrain
from geartrain.train.declaration_files import read_declaration


def load(source: str | Path | Mapping[str, Any]) -> GearTrain:
    """A train from a YAML file, the name of a shipped train, YAML text, or plain data.

    All circuits and cases are found here, so that whatever is wrong with the declaration is said at once.

    Parameters
    ----------
    source : str, Path or mapping
        A path; the name of a shipped train, see `geartrain.shipped`; YAML of several lines; or its keys as plain data.

    Returns
    -------
    GearTrain
        Nothing but its circuits and cases is worked out yet.

    Raises
    ------
    DeclarationError
        With the place (`file:line`) of everything that is wrong, and what to do about it.

    Examples
    --------
    A planetary gear of 24, 18 and 60 teeth whose ring is held: the carrier makes 24 / (24 + 60) of a turn.

    >>> train = load("planetary-24-18-60")
    >>> train.solve()["carrier"]
    Fraction(2, 7)
    """
    train = GearTrain(read_declaration(source))
    _ = train.circuits, train.cases
    return train
