"""What the diagrams of the pages show, as the package answers it: one function a kind of diagram.

Numbers are exact where the package's are, as text (`-2/3`); nothing is typed in that could be asked for.
"""

from __future__ import annotations

from typing import Any

import geartrain
from geartrain.scene import make_scene

Data = dict[str, Any]

_DRAWN = ("bodies", "wheels", "profiles", "pairs", "movement", "back", "lead", "step")


def willis() -> Data:
    """The scene of a planetary, and its speeds with each of its members held."""
    train = geartrain.load("planetary")
    members = {"sun": "sun", "ring": "ring", "carrier": "carrier", "planet": "planet"}
    held = {link: _speeds(_scene(train, f"{link} fixed")) for link in ("ring", "sun", "carrier")}
    return {"scene": _scene(train, "ring fixed"), "held": held, **members}


def _scene(train: geartrain.GearTrain, state: str | None = None) -> Data:
    """What of a scene is drawn and turned."""
    scene = make_scene(train, state).to_dict()
    return {key: scene[key] for key in _DRAWN}


def _speeds(scene: Data) -> dict[str, str]:
    """Over the lead's, by link."""
    return {body["id"]: body["speed"] for body in scene["bodies"]}
