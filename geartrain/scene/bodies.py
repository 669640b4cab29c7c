"""Bodies: links with their axes, and which of them bears which."""

from __future__ import annotations

from geartrain.scene.result import Body
from geartrain.scene.stage import Stage, exact, rounded


def find_bodies(stage: Stage) -> tuple[Body, ...]:
    """All links in the order declared."""
    return tuple(_body(stage, link) for link in stage.train.declaration.links)


def _body(stage: Stage, link: str) -> Body:
    tree, train = stage.train.tree, stage.train
    label = tree.axis(link) or ""
    place = stage.layout.axes.get(label)
    # coaxial links hang on the link that bears their axis, however their joints were declared
    bearer = tree.top.get(link)
    speed = stage.speed(link)
    return Body(
        id=link,
        parent=None if bearer is None else stage.body[bearer],
        axis=label,
        point=(0.0, 0.0, 0.0) if place is None else place.point,
        direction=stage.reference(label),
        sense=stage.sense(link),
        speed=exact(stage.ratio(link)),
        shown=stage.shown(speed),
        decimal=rounded(speed),
        start=stage.start(link),
        role=_role(stage, link),
        bookkeeping=link in train.bookkeeping,
        note=train.declaration.links[link].note or "",
    )


def _role(stage: Stage, link: str) -> str:
    if link == stage.train.declaration.frame:
        return "frame"
    return "carrier" if link in stage.train.tree.top.values() else "arbor"
