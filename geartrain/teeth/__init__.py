"""Tooth forms, one file each; a pair chooses one by its `form`.

The forms are shown here by name, and imported when one is asked for: a train without any needs none.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from geartrain.teeth.any_tooth_form import *  # noqa: F403


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if not name.startswith("_"):
        forms = import_module("geartrain.teeth.any_tooth_form")
        if name in forms.__all__:
            return getattr(forms, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
