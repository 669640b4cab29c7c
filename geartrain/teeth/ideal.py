"""Ideal teeth: the ratio of tooth counts at every instant, without loss."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field


class Ideal(BaseModel):
    """Teeth that transmit the exact ratio at every instant."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    form: Literal["ideal"] = Field(description="The name of this form")
