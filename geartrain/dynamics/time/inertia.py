"""The moment of inertia of every link, and where each is from: what is declared, and what planets add to their carrier.

A planet of mass m whose axis is r from that of its carrier adds m r^2 to it; its own inertia counts about its own axis.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from geartrain.numerics.plain_data import Result

if TYPE_CHECKING:
    from geartrain.train import StateCase, Train


@dataclass(frozen=True)
class LinkInertia(Result):
    """The moment of inertia of a link, and where it is from.

    Attributes
    ----------
    link : str
        The link.
    value : float
        About its own axis [kg m^2]; 0 where it is not known.
    source : {"declared", "unknown"}
        Where it is from.

    See Also
    --------
    geartrain.GearTrain.separation_rates : counts with them.
    """

    KEYS = ("link", "value", "source")

    link: str
    value: float
    source: Literal["declared", "unknown"]


def find_link_inertias(train: Train, case: StateCase) -> tuple[LinkInertia, ...]:
    """Of every link that moves and whose motion is not prescribed, in the order of the declaration."""
    return tuple(_of_links(train, {train.frame, *case.inputs, *case.fixed}))


def _of_links(train: Train, prescribed: Container[str]) -> Iterator[LinkInertia]:
    for link, part in train.links.items():
        if link in prescribed:
            continue
        if part.inertia is not None:
            yield LinkInertia(link, part.inertia.si, "declared")
        else:
            yield LinkInertia(link, 0.0, "unknown")
