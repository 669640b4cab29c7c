"""The coefficient of restitution as a train declares it: Newton's law of impact.

Where two sides meet at a speed u they part at e u, with e from 0 (they stay together) to 1 (nothing is lost); of the
energy in u the part 1 - e^2 is lost.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import Figure


def _from_nothing_to_all(figure: Figure) -> Figure:
    if not 0 <= figure.value <= 1:
        raise PydanticCustomError(
            "restitution",
            "a restitution of {text} is none",
            {
                "text": figure.text,
                "fix": "it is from 0, where what meets stays together, to 1, where no energy is lost",
            },
        )
    return figure


DeclaredRestitution = Annotated[Figure, AfterValidator(_from_nothing_to_all)]
"""A coefficient of restitution, 0 to 1."""
