"""From a path, a shipped name, text or plain data to a train that answers."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from geartrain.analysis.gear_train import GearTrain
from geartrain.train.declaration_files import read_declaration


def load(source: str | Path | Mapping[str, Any]) -> GearTrain:
    """A train from a YAML file, the name of a shipped train, YAML text (of several lines), or plain data.

    All circuits and cases are found here, so that whatever is wrong with the declaration is said at once, with its
    place.
    Raises `DeclarationError`.
    """
    train = GearTrain(read_declaration(source))
    _ = train.circuits, train.cases
    return train
