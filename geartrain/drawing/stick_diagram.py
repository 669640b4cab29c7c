"""The functional diagram of a train, as textbooks draw it: axes level, wheels upright, meshes as ends that touch.

Nothing is to scale. Axes that are not parallel are turned into the plane, and the ends of their wheels are slanted.
"""

from __future__ import annotations

from collections.abc import Iterator

from geartrain.analysis.gear_train import GearTrain
from geartrain.drawing.backend import Axes, Figure, Line2D, Patch, Rectangle
from geartrain.drawing.stick_elements import draw_elements, width_of
from geartrain.drawing.stick_grid import StickCrank, StickShaft
from geartrain.drawing.stick_skeleton import StickMesh, StickSkeleton, find_skeleton
from geartrain.drawing.style import (
    BLACK,
    BLUE,
    GREY,
    LETTER,
    ORANGE,
    PALE,
    PURPLE,
    SMALL,
    sheet,
    title_of,
    too_many,
    write,
)

_MOST = 160  # gear pairs
_TICK, _COLUMN = 0.085, 0.3  # inches: half a tooth mark, a column
_FINE, _NAME = 6.8, 8.0  # points
_HEAD, _FOOT = 0.7, 0.5
_ENTRY = 1.35  # inches of a legend in one row


def stick_figure(train: GearTrain, labels: bool = True, state: str | None = None) -> Figure:
    """Axes, shafts, wheels with their counts, cranks of carriers, the frame hatched; brakes and clutches beside them.

    state   whose brakes and clutches are drawn closed, by default the first
    Raises `QuestionError` for more pairs than a page holds.
    """
    too_many(train, len(train.circuits), _MOST, "pairs")
    declared = train.declaration
    skeleton = find_skeleton(train)
    margin = 0.5 + max((len(link) for link in declared.links), default=1) * 8 * LETTER
    declared.check_state(state)
    elements = width_of(train)
    width = max(skeleton.width + margin + 0.6 + elements, 5.5)
    figure, axes = sheet(width, skeleton.height + _HEAD + _FOOT, title_of(declared.name, declared.title))
    axes.set_xlim(-margin, width - margin)
    axes.set_ylim(-_FOOT, skeleton.height + _HEAD)
    for text in list(axes.texts):
        text.set_position((0.15 - margin, skeleton.height + _HEAD - 0.12))
    drawing = _Drawing(axes, train, skeleton, labels)
    drawing.draw_axes()
    for mesh in skeleton.meshes:
        drawing.draw_mesh(mesh)
    for crank in skeleton.cranks:
        drawing.draw_crank(crank)
    for wheel, x in skeleton.lone:
        drawing.draw_lone(wheel, x)
    for shaft in skeleton.shafts.values():
        drawing.draw_shaft(shaft)
    if elements:
        right = max(max(shaft.xs) for shaft in skeleton.shafts.values()) + 0.9
        draw_elements(axes, train, train.state_or_first(state), right, skeleton.height / 2)
    entries = list(_legend(train))
    columns = 5 if len(entries) < 6 and width > 5 * _ENTRY else 3
    figure.legend(handles=entries, loc="lower center", ncols=columns, fontsize=SMALL - 1.5, frameon=False)
    return figure


class _Drawing:
    """A skeleton being drawn; wheels that stand in several columns are named once."""

    def __init__(self, axes: Axes, train: GearTrain, skeleton: StickSkeleton, labels: bool) -> None:
        self.axes, self.train, self.skeleton, self.labels = axes, train, skeleton, labels
        self.feet: dict[str, tuple[float, float]] = {}
        self.names: list[tuple[float, float, float, float]] = []
        self.uprights = [(mesh.x, mesh.low, mesh.high) for mesh in skeleton.meshes]
        self.uprights += [
            (mesh.x + _COLUMN, min(mesh.low, mesh.meet), max(mesh.high, mesh.meet))
            for mesh in skeleton.meshes
            if mesh.ring
        ]

    def draw_axes(self) -> None:
        """Centre lines."""
        for axis, (low, _) in self.skeleton.rows.items():
            xs = [x for shaft in self.skeleton.shafts.values() if shaft.axis == axis for x in shaft.xs]
            ends = [min(xs) - 0.2, max(xs) + 0.25]
            self._line(ends, [low, low], PALE, 0.8, linestyle="-.", zorder=1, gid=f"axis {axis}")
            if self.labels:
                write(self.axes, ends[1] + 0.05, low, axis, GREY, ha="left", fontsize=_FINE, fontstyle="italic")

    def draw_shaft(self, shaft: StickShaft) -> None:
        """A link's shaft with its name, in a bearing if the frame bears it."""
        left, right = min(shaft.xs) - 0.14, max(shaft.xs) + 0.14
        self._line([left, right], [shaft.y, shaft.y], "white", 4.5, zorder=5)
        self._line([left, right], [shaft.y, shaft.y], BLACK, 1.8, zorder=6, gid=f"link {shaft.link}")
        if self.train.tree.top[shaft.link] == self.train.declaration.frame:
            self._ground(left + 0.04, shaft.y - 0.075)
        if self.labels:
            x, y, ha = self._name_spot(shaft.link, left, right, shaft.y)
            write(self.axes, x, y, shaft.link, ha=ha, fontsize=_NAME, fontweight="bold", zorder=10)

    def _name_spot(self, link: str, left: float, right: float, y: float) -> tuple[float, float, str]:
        """Where a name stands, and to which end: before its shaft, or over it where something stands there."""
        wide = len(link) * _NAME * LETTER
        spots = [(left - 0.04 - wide, y), (left + 0.02, y + 0.1), (right - wide, y + 0.1), (right + 0.04, y + 0.1)]

        def taken(spot: tuple[float, float]) -> int:
            start, end, low, high = spot[0] - 0.03, spot[0] + wide + 0.03, spot[1] - 0.07, spot[1] + 0.07
            # words stand on the right of each upright
            uprights = sum(x - 0.02 < end and start < x + 0.14 and low < top and bottom < high
                           for x, bottom, top in self.uprights)  # fmt: skip
            return uprights + sum(a < end and start < b and low < top and bottom < high
                                  for a, b, bottom, top in self.names)  # fmt: skip

        x, middle = min(spots, key=taken)
        self.names.append((x, x + wide, middle - 0.07, middle + 0.07))
        return (left - 0.04, middle, "right") if middle == y else (x, middle, "left")

    def draw_mesh(self, mesh: StickMesh) -> None:
        """Two wheels up to where they touch, a pin in its slot or hole, or two links that stay parallel."""
        low, high = (self._foot(link, mesh) for link in mesh.ends)
        if mesh.kind == "ring":
            self._draw_ring(mesh, low, high)
        elif mesh.kind == "parallel":
            self._draw_parallel(mesh, low, high)
        elif mesh.kind.startswith("pin"):
            self._draw_pin(mesh, low, high)
        else:
            for wheel, link, foot, side in zip(mesh.wheels, mesh.ends, (low, high), (-1, 1), strict=True):
                end = mesh.meet + 0.022 * side
                self._upright(mesh.x, foot, end, wheel, link)
                self._tick(mesh.x, end, mesh.kind)

    def _foot(self, link: str, mesh: StickMesh) -> float:
        shaft = self.skeleton.shafts.get(link)
        if shaft is not None:
            return shaft.y
        carrier = next(circuit.carrier for circuit in self.train.circuits if circuit.id == mesh.name)
        return self.skeleton.rows[self.skeleton.shafts[carrier].axis][0] - 0.22

    def _draw_ring(self, mesh: StickMesh, low: float, high: float) -> None:
        """The planet beyond its axis, the ring over it and down (or under it and up) beside it."""
        ring = mesh.wheels.index(mesh.ring)
        planet, side = 1 - ring, 1 if ring == 0 else -1
        foot = (low, high)
        end = mesh.meet - 0.022 * side
        self._upright(mesh.x, foot[planet], end, mesh.wheels[planet], mesh.ends[planet])
        self._tick(mesh.x, end, "spur")
        over, beside = mesh.meet + 0.022 * side, mesh.x + _COLUMN
        self._line([mesh.x - _TICK, beside], [over, over], BLUE, 2.0, zorder=4)
        self._upright(beside, foot[ring], over, mesh.ring, mesh.ends[ring])

    def _draw_pin(self, mesh: StickMesh, low: float, high: float) -> None:
        pin = next(each.pin for each in self.train.declaration.couplings if each.name == mesh.name)
        for link, foot in zip(mesh.ends, (low, high), strict=True):
            self._line([mesh.x, mesh.x], [foot, mesh.meet], PURPLE, 2.0, zorder=3, gid=f"coupling {mesh.name}")
            if link == pin:
                self.axes.plot([mesh.x], [mesh.meet], "o", color=PURPLE, markersize=5, zorder=5)
            else:
                box = Rectangle((mesh.x - 0.05, mesh.meet - 0.1), 0.1, 0.2, zorder=4)
                box.set(facecolor="white", edgecolor=PURPLE, linewidth=1.4)
                self.axes.add_artist(box)
        if self.labels:
            self._write_beside(mesh.x, mesh.meet, mesh.name, PURPLE)

    def _draw_parallel(self, mesh: StickMesh, low: float, high: float) -> None:
        """Whatever keeps two links parallel: two strokes between them, with a gap."""
        for foot, side in ((low, -1), (high, 1)):
            level = mesh.meet + 0.03 * side
            self._line([mesh.x, mesh.x], [foot, level], PURPLE, 2.0, zorder=3, gid=f"coupling {mesh.name}")
            self._line([mesh.x - _TICK, mesh.x + _TICK], [level, level], PURPLE, 2.0, zorder=4)
        if self.labels:
            self._write_beside(mesh.x, mesh.meet, mesh.name, PURPLE)

    def _upright(self, x: float, foot: float, end: float, wheel: str, link: str) -> None:
        """A wheel from its shaft to where it touches; the second time, joined to the first."""
        self._line([x, x], [foot, end], BLUE, 2.0, zorder=3, gid=f"wheel {wheel}")
        if link == self.train.declaration.frame:
            self._ground(x, foot)
        known = self.feet.get(wheel)
        if known is not None and abs(known[0] - x) > 1e-9:  # more than rounding beside where it stood
            level = foot + (0.09 if end > foot else -0.09)
            self._line([known[0], x], [level, level], BLUE, 2.0, zorder=3)
        if known is None and self.labels:
            count = self.train.declaration.wheels[wheel][1].count
            self._write_beside(x, (foot + end) / 2, f"{wheel} {count}", BLUE)
        self.feet.setdefault(wheel, (x, foot))

    def draw_lone(self, wheel: str, x: float) -> None:
        """A wheel that meshes with nothing."""
        link = self.train.declaration.wheels[wheel][0]
        y = self.skeleton.shafts[link].y
        self._upright(x, y, y + 0.4, wheel, link)
        self._tick(x, y + 0.4, "spur")

    def draw_crank(self, crank: StickCrank) -> None:
        """A carrier's arm, ending in a bearing about the axis it bears."""
        y = self.skeleton.shafts[crank.carrier].y
        far = self.skeleton.rows[crank.axis][0]
        self._line([crank.x, crank.x], [y, far], ORANGE, 3.2, zorder=3, gid=f"crank {crank.carrier}")
        for side in (-1, 1):
            level = far + 0.05 * side
            self._line([crank.x - 0.08, crank.x + 0.08], [level, level], ORANGE, 2.0, zorder=7)

    def _tick(self, x: float, y: float, kind: str) -> None:
        """The mark of teeth at the end of a wheel: level, slanted (bevel), upright too (contrate), or long (worm)."""
        lean = {"bevel": 0.06, "contrate": 0.06}.get(kind, 0.0)
        reach = _TICK * (1.6 if kind == "worm" else 1.0)
        style = (0, (1.2, 0.8)) if kind == "worm" else "-"
        self._line([x - reach, x + reach], [y - lean, y + lean], BLUE, 2.0, zorder=4, linestyle=style)

    def _ground(self, x: float, y: float) -> None:
        box = Rectangle((x - 0.09, y - 0.045), 0.18, 0.09, hatch="//////", zorder=4)
        box.set(facecolor="white", edgecolor=GREY, linewidth=0.7)
        self.axes.add_artist(box)

    def _write_beside(self, x: float, y: float, text: str, color: str) -> None:
        write(self.axes, x + 0.08, y, text, color, fontsize=_FINE, rotation=90, zorder=9)

    def _line(self, xs: list[float], ys: list[float], color: str, width: float, **how: object) -> None:
        self.axes.plot(xs, ys, color=color, linewidth=width, solid_capstyle="butt", **how)  # type: ignore[arg-type]


def _legend(train: GearTrain) -> Iterator[Line2D | Patch]:
    yield Line2D([], [], color=BLACK, linewidth=1.8, label="links on their axes")
    yield Line2D([], [], color=BLUE, linewidth=2.0, label="wheels")
    yield Patch(facecolor="white", edgecolor=GREY, hatch="//////", label="frame")
    if any(circuit.carrier != train.declaration.frame for circuit in train.circuits):
        yield Line2D([], [], color=ORANGE, linewidth=3.2, label="carriers")
    kinds = {coupling.kind for coupling in train.declaration.couplings}
    if kinds - {"parallel"}:
        holes = "pins in holes" if kinds - {"parallel"} == {"pins_in_holes"} else "pins in slots"
        yield Line2D([], [], color=PURPLE, linewidth=2.0, marker="o", label=holes)
    if "parallel" in kinds:
        ends = {"marker": "|", "markersize": 8, "markeredgewidth": 2.0}
        yield Line2D([], [], color=PURPLE, linewidth=2.0, label="kept parallel", **ends)  # type: ignore[arg-type]
    if train.declaration.clutches:
        yield Line2D([], [], color=PURPLE, linewidth=2.6, label="closed brakes and clutches")
        yield Line2D([], [], color=GREY, linewidth=2.6, label="open ones")
