"""Tooth forms, one file each; a pair chooses one by its `form`."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from geartrain.teeth.ideal import Ideal
from geartrain.teeth.triangular import Triangular

ToothForm = Annotated[Ideal | Triangular, Field(discriminator="form")]

__all__ = ["Ideal", "ToothForm", "Triangular"]
