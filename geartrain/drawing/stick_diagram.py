"""The functional diagram of a train, as textbooks draw it: axes level, wheels upright, meshes as ends that touch.

Nothing is to scale. Axes that are not parallel are turned into the plane, and the ends of their wheels are slanted.
"""

from __future__ import annotations

from collections.abc import Iterator

from geartrain.analysis.gear_train import GearTrain
from geartrain.drawing.backend import Axes, Figure, Line2D, Patch, Rectangle
from geartrain.drawing.stick_elements import PLATE, STEM, draw_elements, width_of
from geartrain.drawing.stick_grid import StickCrank, StickShaft
from geartrain.drawing.stick_skeleton import StickMesh, StickSkeleton, find_skeleton
from geartrain.drawing.stick_words import StickWords
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
)

_MOST = 160  # gear pairs
_TICK, _COLUMN = 0.085, 0.3  # inches: half a tooth mark, a column
_NAME = 8.5  # points
_LINK, _WHEEL, _CARRIER, _COUPLING = 1.1, 2.8, 4.0, 1.8  # points: what a line is, is seen without its colour
_TOUCH = 0.032  # inches from where two wheels meet to the middle of either's mark
_BEARING = 0.08  # inches: half of the mark of a carrier's bearing
_LONE = 0.55  # inches of a wheel that meshes with nothing
_HEAD, _FOOT = 0.7, 0.7


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
    needed = skeleton.width + margin + 0.6 + elements
    width = max(needed, 5.5)
    margin += (width - needed) / 2
    figure, axes = sheet(width, skeleton.height + _HEAD + _FOOT, title_of(declared.name, declared.title))
    axes.set_xlim(-margin, width - margin)
    axes.set_ylim(-_FOOT, skeleton.height + _HEAD)
    for text in list(axes.texts):
        text.set_position((0.15 - margin, skeleton.height + _HEAD - 0.12))
    drawing = _Drawing(axes, train, skeleton)
    drawing.draw_axes()
    for mesh in skeleton.meshes:
        drawing.draw_mesh(mesh)
    for crank in skeleton.cranks:
        drawing.draw_crank(crank)
    for wheel, x in skeleton.lone:
        drawing.draw_lone(wheel, x)
    for shaft in skeleton.shafts.values():
        drawing.draw_shaft(shaft)
    if labels:
        drawing.words.write(axes)
    if elements:
        right = max(max(shaft.xs) for shaft in skeleton.shafts.values()) + 0.9
        draw_elements(axes, train, train.declaration.state_or_first(state), right, skeleton.height / 2)
    entries = list(_legend(train))
    columns = min(len(entries), int(width / 1.35), 5)
    figure.legend(handles=entries, loc="lower center", ncols=columns, fontsize=SMALL - 1.5, frameon=False)
    return figure


class _Drawing:
    """A skeleton being drawn; wheels that stand in several columns are named once."""

    def __init__(self, axes: Axes, train: GearTrain, skeleton: StickSkeleton) -> None:
        self.axes, self.train, self.skeleton = axes, train, skeleton
        self.couplings = {each.name: each for each in train.declaration.couplings}
        self.feet: dict[str, tuple[float, float]] = {}
        self.words = StickWords()
        for mesh in skeleton.meshes:
            ends = [mesh.meet, *(self._foot(link, mesh) for link in mesh.ends)]
            for x in (mesh.x, mesh.x + _COLUMN) if mesh.ring else (mesh.x,):
                self.words.keep_off((x, x), (min(ends), max(ends)))
        for crank in skeleton.cranks:
            far = skeleton.rows[crank.axis][0]
            self.words.keep_off((crank.x, crank.x), (skeleton.shafts[crank.carrier].y, far))
            self.words.keep_off((crank.x - _BEARING, crank.x + _BEARING), (far - 0.07, far + 0.07))

    def draw_axes(self) -> None:
        """Centre lines."""
        for axis, (low, _) in self.skeleton.rows.items():
            xs = [x for shaft in self.skeleton.shafts.values() if shaft.axis == axis for x in shaft.xs]
            ends = [min(xs) - 0.2, max(xs) + 0.25]
            self._line(ends, [low, low], PALE, 0.8, linestyle="-.", zorder=1, gid=f"axis {axis}")
            self.words.name_axis(axis, ends[1], low)

    def draw_shaft(self, shaft: StickShaft) -> None:
        """A link's shaft with its name, in a bearing if the frame bears it."""
        left, right = min(shaft.xs) - 0.14, max(shaft.xs) + 0.14
        self._line([left, right], [shaft.y, shaft.y], "white", _LINK + 3.0, zorder=5)
        self._line([left, right], [shaft.y, shaft.y], BLACK, _LINK, zorder=6, gid=f"link {shaft.link}")
        if self.train.kinematics.tree.top[shaft.link] == self.train.declaration.frame:
            self._ground(left + 0.04, shaft.y - 0.075)
        self.words.keep_off((left, right), (shaft.y, shaft.y))
        self.words.name_link(shaft.link, left, right, shaft.y)

    def draw_mesh(self, mesh: StickMesh) -> None:
        """Two wheels up to where they touch, a pin in its slot or hole, or two links that stay parallel."""
        low, high = (self._foot(link, mesh) for link in mesh.ends)
        if mesh.kind == "ring":
            self._draw_ring(mesh, low, high)
        elif mesh.name in self.couplings:
            self._draw_coupling(mesh, low, high)
        else:
            for wheel, link, foot, side in zip(mesh.wheels, mesh.ends, (low, high), (-1, 1), strict=True):
                end = mesh.meet + _TOUCH * side
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
        end = mesh.meet - _TOUCH * side
        self._upright(mesh.x, foot[planet], end, mesh.wheels[planet], mesh.ends[planet])
        self._tick(mesh.x, end, "spur")
        over, beside = mesh.meet + _TOUCH * side, mesh.x + _COLUMN
        self._line([mesh.x - _TICK, beside], [over, over], BLUE, _WHEEL, zorder=4)
        self._upright(beside, foot[ring], over, mesh.ring, mesh.ends[ring])

    def _draw_coupling(self, mesh: StickMesh, low: float, high: float) -> None:
        """A pin in its slot; of links that turn alike, two bars side by side."""
        coupling = self.couplings[mesh.name]
        parallel = coupling.kind == "parallel"
        for link, foot, side in zip(mesh.ends, (low, high), (-1, 1), strict=True):
            end = mesh.meet + 0.03 * side * parallel
            self._line([mesh.x, mesh.x], [foot, end], PURPLE, _COUPLING, zorder=3, gid=f"coupling {mesh.name}")
            if parallel:
                self._line([mesh.x - _TICK, mesh.x + _TICK], [end, end], PURPLE, _COUPLING, zorder=5)
            elif link == coupling.pin:
                self.axes.plot([mesh.x], [mesh.meet], "o", color=PURPLE, markersize=5, zorder=5)
            else:
                box = Rectangle((mesh.x - 0.05, mesh.meet - 0.1), 0.1, 0.2, zorder=4)
                box.set(facecolor="white", edgecolor=PURPLE, linewidth=1.4)
                self.axes.add_artist(box)
                self.words.keep_off((mesh.x - 0.06, mesh.x + 0.06), (mesh.meet - 0.12, mesh.meet + 0.12))
        self.words.name_upright(mesh.name, mesh.x, (low, high), PURPLE)

    def _upright(self, x: float, foot: float, end: float, wheel: str, link: str) -> None:
        """A wheel from its shaft to where it touches; the second time, joined to the first."""
        self._line([x, x], [foot, end], BLUE, _WHEEL, zorder=3, gid=f"wheel {wheel}")
        if link == self.train.declaration.frame:
            self._ground(x, foot)
        known = self.feet.get(wheel)
        if known is not None and abs(known[0] - x) > 1e-9:  # more than rounding beside where it stood
            level = foot + (0.09 if end > foot else -0.09)
            self._line([known[0], x], [level, level], BLUE, _WHEEL, zorder=3)
        if known is None:
            count = self.train.declaration.wheels[wheel][1].count
            self.words.name_upright(f"{wheel} {count}", x, (foot, end), BLUE)
        self.feet.setdefault(wheel, (x, foot))

    def draw_lone(self, wheel: str, x: float) -> None:
        """A wheel that meshes with nothing."""
        link = self.train.declaration.wheels[wheel][0]
        y = self.skeleton.shafts[link].y
        self._upright(x, y, y + _LONE, wheel, link)
        self._tick(x, y + _LONE, "spur")

    def draw_crank(self, crank: StickCrank) -> None:
        """A carrier's arm, ending in a bearing about the axis it bears."""
        y = self.skeleton.shafts[crank.carrier].y
        far = self.skeleton.rows[crank.axis][0]
        self._line([crank.x, crank.x], [y, far], ORANGE, _CARRIER, zorder=3, gid=f"crank {crank.carrier}")
        for side in (-1, 1):
            level = far + 0.05 * side
            self._line(
                [crank.x - _BEARING, crank.x + _BEARING], [level, level], ORANGE, _WHEEL, zorder=7, gid="bearing"
            )

    def _tick(self, x: float, y: float, kind: str) -> None:
        """The mark of teeth at the end of a wheel: level, slanted (bevel), upright too (contrate), or long (worm)."""
        lean = {"bevel": 0.06, "contrate": 0.06}.get(kind, 0.0)
        reach = _TICK * (1.6 if kind == "worm" else 1.0)
        style = (0, (1.2, 0.8)) if kind == "worm" else "-"
        self.words.keep_off((x - reach, x + reach), (y - lean, y + lean))
        self._line([x - reach, x + reach], [y - lean, y + lean], BLUE, _WHEEL, zorder=4, linestyle=style, gid="teeth")

    def _ground(self, x: float, y: float) -> None:
        self.words.keep_off((x - 0.09, x + 0.09), (y - 0.045, y + 0.045))
        box = Rectangle((x - 0.09, y - 0.045), 0.18, 0.09, hatch="//////", zorder=4)
        box.set(facecolor="white", edgecolor=GREY, linewidth=0.7)
        self.axes.add_artist(box)

    def _line(self, xs: list[float], ys: list[float], color: str, width: float, **how: object) -> None:
        self.axes.plot(xs, ys, color=color, linewidth=width, solid_capstyle="butt", **how)  # type: ignore[arg-type]


def _legend(train: GearTrain) -> Iterator[Line2D | Patch]:
    yield Line2D([], [], color=BLACK, linewidth=_LINK, label="links on their axes")
    yield Line2D([], [], color=BLUE, linewidth=_WHEEL, label="wheels")
    yield Patch(facecolor="white", edgecolor=GREY, hatch="//////", label="frame")
    if any(circuit.carrier != train.declaration.frame for circuit in train.circuits):
        yield Line2D([], [], color=ORANGE, linewidth=_CARRIER, label="carriers")
    kinds = {coupling.kind for coupling in train.declaration.couplings}
    if kinds - {"parallel"}:
        holes = "pins in holes" if kinds - {"parallel"} == {"pins_in_holes"} else "pins in slots"
        yield Line2D([], [], color=PURPLE, linewidth=_COUPLING, marker="o", label=holes)
    if "parallel" in kinds:
        ends = {"marker": "|", "markersize": 8, "markeredgewidth": 2.0}
        yield Line2D([], [], color=PURPLE, linewidth=_COUPLING, label="kept parallel", **ends)  # type: ignore[arg-type]
    if train.declaration.clutches:
        ends = {"linewidth": PLATE, "marker": "|", "markersize": 10, "markeredgewidth": STEM}
        for color, words in ((PURPLE, "closed brakes and clutches"), (GREY, "open ones")):
            yield Line2D([], [], color=color, label=words, **ends)  # type: ignore[arg-type]
