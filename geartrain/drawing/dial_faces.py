"""Dial faces: scales, spirals, and pointers at their angles after some turns of the driving link."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import cos, pi

import numpy as np

from geartrain.drawing.arrangement import text_width
from geartrain.drawing.style import (
    BLACK,
    FINE,
    GREY,
    SMALL,
    Axes,
    Circle,
    Figure,
    Polygon,
    after_turns,
    series_look,
    sheet,
    title_of,
    write,
)
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import decimal, is_short
from geartrain.scene import Scene
from geartrain.scene.dial_scale import DialScale, clock_point, engrave, plain_circle
from geartrain.scene.pose import body_errors, turns_of
from geartrain.scene.stroke_letters import HANDS
from geartrain.scene.train_scene import Pointer

_MOST = 60  # maximum number of faces on a page
_FACE, _ROW, _HEAD = 3.0, 0.2, 0.5  # inches: a face with its margin, a line below it, the title
_OUTER = _FACE / 2 - 0.2  # inches: radius of a face
_FINEST = 0.3  # points: minimum line width
_MOON = 0.75  # inches: radius of the ball of a Moon's phase
_DECIMALS = 9  # decimals of a turn to which an error is rounded, as its floats carry noise
_PLAIN = len(HANDS["needle"].stations)  # outlines with more points than a needle are filled
_SAMPLE, _DASHED = 0.45, 0.75  # inches: sample of a plain hand for the key, and of a dashed one


@dataclass(frozen=True, slots=True)
class PointerReading:
    """Position of a pointer after a number of turns of the driving link, with the length and outline of its hand."""

    output: str
    turned: Fraction | None
    """Exact mean rotation since the zero pose [turns], clockwise for the reader; None if it is not determined."""
    error: float
    """Contribution of the starting angle, teeth and pins to the reading [turns], clockwise for the reader."""
    reach: float = 1.0
    """Length of the hand divided by the radius of its scale."""
    outline: Sequence[tuple[float, float]] = ()
    """Outline of the hand: pairs (x, half the width), both divided by the length of the hand."""

    @property
    def at(self) -> Fraction:
        """Position of the pointer [turns], clockwise from the zero mark; an undetermined mean rotation counts as 0."""
        # the error is rounded, as -1e-17 turns would move a hand on a line to the cell before the line
        return (self.turned or Fraction(0)) + Fraction(round(self.error, _DECIMALS))


@dataclass(frozen=True, slots=True)
class DialPicture:
    """Dial face in a figure: its name and title, its scale or ball, and the pointers that are read on it."""

    name: str
    """Name of the dial; empty for a plain face."""
    scale: DialScale
    pointers: tuple[int, ...]
    """Indices of the pointers that are read on the face."""
    title: str = ""
    """Text above the face. If it is empty, the name is written."""
    ball: bool = False
    """True if the face shows a half-black ball for the Moon's phase instead of a scale."""


def pointer_readings(scene: Scene, turns: Fraction) -> list[PointerReading]:
    """Return the reading of every pointer of a scene after `turns` of its driving link."""
    error = body_errors(scene, turns)
    found = []
    for pointer in scene.pointers:
        body, base = scene.bodies[pointer.body], scene.bodies[pointer.base]
        known = pointer.speed is not None
        # about the axis of the output: the product of the senses is -1 if the axis of its base is opposite
        start = (body.start - base.start * body.sense * base.sense) / (2 * pi)
        swing = float(error[pointer.body] - error[pointer.base] * body.sense * base.sense) / (2 * pi) + start
        turned = turns_of(pointer.speed, turns) * pointer.sense if known else None
        hand = (pointer.reach, pointer.outline)
        found.append(PointerReading(pointer.output, turned, pointer.sense * swing, *hand))
    return found


def dials_figure(
    scene: Scene, turns: Fraction = Fraction(0), outputs: Sequence[str] = (), labels: bool = True
) -> Figure:
    """Return a figure with the dials of a scene after `turns` of its driving link.

    Outputs without a dial are drawn on a plain face if they are named or if no output has a dial.

    outputs   names of the outputs to draw, by default all outputs that are read on a dial

    Raise `QuestionError` for unknown outputs, for trains without outputs, and for more faces than fit on a page.
    """
    faces = find_faces(scene, outputs)
    readings = pointer_readings(scene, turns)
    columns = min(len(faces), 4)
    rows = [faces[at : at + columns] for at in range(0, len(faces), columns)]
    tall = [_FACE + 0.35 + (_ROW * max(len(face.pointers) for face in row) if labels else 0.0) for row in rows]
    senses = Counter(
        scene.pointers[at].text.removesuffix(" as read")
        for face in faces
        for at in face.pointers
        if scene.pointers[at].speed
    )
    usual = senses.most_common(1)[0][0] if senses else ""  # sense of rotation of most hands
    keys = [
        _sample_length(face) + text_width(_reading_text(scene.pointers[at], readings[at], face, usual))
        for face in faces
        for at in face.pointers
    ]
    wide = max(_FACE, max(keys) + 0.3) if labels else _FACE
    width = max(wide * columns, 5.0)
    title = title_of(scene.name, scene.title) + after_turns(scene, turns)
    figure, axes = sheet(width, _HEAD + sum(tall) + 0.1, title)
    top = sum(tall) + 0.1
    for row, high in zip(rows, tall, strict=True):
        for column, face in enumerate(row):
            x = width / 2 + (column - (columns - 1) / 2) * wide
            centre = (x, top - _FACE / 2 - 0.2)
            _draw_face(axes, face, readings, centre)
            if labels:
                _draw_key(axes, face, scene, readings, centre, usual)
        top -= high
    if labels and usual:
        axes.text(0.15, 0.08, f"Hands turn {usual} unless noted.", fontsize=FINE, color=GREY, gid="sense")
    return figure


def find_faces(scene: Scene, outputs: Sequence[str]) -> list[DialPicture]:
    """Return the dial faces to draw. Raise `QuestionError` for unknown outputs, and for 0 or more than 60 faces."""
    known = {pointer.output: at for at, pointer in enumerate(scene.pointers) if scene.asks}
    for name in outputs:
        if name not in known:
            fix = f"choose from {', '.join(known)}" if known else "declare `outputs`"
            what = f"'{scene.name}' has no output '{name}'"
            raise QuestionError(Problem(what, "only declared outputs have dials", fix))
    wanted = [known[name] for name in outputs] or list(known.values())
    on: dict[int, list[int]] = {}
    for at in wanted:
        dial = scene.pointers[at].dial
        if dial is not None:
            on.setdefault(dial, []).append(at)
    faces = [
        DialPicture(face.id, face.scale, tuple(pointers), face.title, face.look == "ball")
        for face, pointers in ((scene.dials[dial], pointers) for dial, pointers in on.items())
    ]
    if outputs or not faces:
        faces += [DialPicture("", plain_circle(), (at,)) for at in wanted if scene.pointers[at].dial is None]
    if not faces:
        what = f"'{scene.name}' has no dial to draw"
        raise QuestionError(Problem(what, "it declares no `outputs`", "declare `outputs` and `dials`"))
    if len(faces) > _MOST:
        what, why = f"{len(faces)} dial faces do not fit on a page", f"a page has space for at most {_MOST} faces"
        raise QuestionError(Problem(what, why, "select fewer outputs with --of"))
    return faces


# -------------------------------------------------------------------------------------------------------------- drawing


def place(centre: tuple[float, float], radius: float, turn: float | Fraction) -> tuple[float, float]:
    """Return the point at a radius from a centre and an angle [turns] measured clockwise from the top."""
    x, y = clock_point(radius, turn)
    return centre[0] + x, centre[1] + y


def _draw_face(axes: Axes, face: DialPicture, readings: Sequence[PointerReading], centre: tuple[float, float]) -> None:
    """Draw the scale, the hands and the name of a dial face."""
    outer = _OUTER
    if face.ball:
        _draw_moon(axes, readings[face.pointers[0]], centre)
    else:
        _draw_scale(axes, face, centre, outer)
    for order, at in enumerate(() if face.ball else face.pointers):
        # hands of one dial differ in length, so that a hand does not hide another with the same reading
        share = 1.0 if face.scale.turns > 1 else (readings[at].reach or 0.97) - 0.07 * (order % 10)
        _draw_pointer(axes, face, readings[at], centre, outer * share, order)
    if not face.ball:
        axes.add_patch(Circle(centre, 0.05, facecolor=BLACK, zorder=7))
    name = face.name or readings[face.pointers[0]].output
    title, y = face.title or name, centre[1] + _FACE / 2 + 0.02
    write(axes, centre[0], y, title, fontsize=SMALL, fontweight="bold", gid=f"dial {name}")


def _draw_moon(axes: Axes, reading: PointerReading, centre: tuple[float, float]) -> None:
    """Draw the ball that shows the phase of the Moon, with its axis upright; its black half is in front at angle 0."""
    axes.add_patch(Circle(centre, _MOON, facecolor=BLACK, edgecolor=BLACK, zorder=3, gid="moon"))
    turn = 2 * pi * float(reading.at % 1)
    side = 1 if turn <= pi else -1
    angle = np.linspace(-pi / 2, pi / 2, 61)
    limb = np.column_stack([side * np.cos(angle), np.sin(angle)])
    terminator = limb[::-1] * (np.cos(turn), 1.0)  # half an ellipse: the projection of a great circle
    lit = np.array(centre) + _MOON * np.concatenate([limb, terminator])
    axes.add_patch(Polygon(lit, facecolor="white", edgecolor="none", zorder=4, gid="lit"))


def _draw_key(
    axes: Axes,
    face: DialPicture,
    scene: Scene,
    readings: Sequence[PointerReading],
    centre: tuple[float, float],
    usual: str,
) -> None:
    """Draw a legend below a dial face, with one line of text for each hand that shows its style and its reading.

    usual   sense of rotation that is omitted from the readings
    """
    reading_text = [_reading_text(scene.pointers[at], readings[at], face, usual) for at in face.pointers]
    sample = _sample_length(face)
    left = centre[0] - (max(map(text_width, reading_text)) + sample) / 2
    for order, words in enumerate(reading_text):
        y, look = centre[1] - _OUTER - 0.3 - _ROW * order, series_look(order)
        axes.plot([left, left + sample - 0.08], [y, y], linewidth=2.2, zorder=6, gid="key", **look)
        write(axes, left + sample, y, words, look["color"], ha="left", fontsize=FINE)


def _sample_length(face: DialPicture) -> float:
    """Return the length [inch] of the line sample that shows the style of one pointer in the legend of a dial."""
    return _SAMPLE if len(face.pointers) == 1 else _DASHED


def _draw_scale(axes: Axes, face: DialPicture, centre: tuple[float, float], outer: float) -> None:
    """Draw all engraved lines of a dial face: rims, division lines between cells, and letters."""
    for part in engrave(face.scale):
        points = [point for line in part.lines for point in (*line, (np.nan, np.nan))]
        colour = BLACK if part.kind in ("rim", "letters") else GREY
        wide = max(72 * outer * part.width, _FINEST)
        xs, ys = (outer * np.array(points) + centre).T
        axes.plot(xs, ys, color=colour, linewidth=wide, zorder=3, gid=f"{part.kind} {face.name}")


def _draw_pointer(
    axes: Axes, face: DialPicture, reading: PointerReading, centre: tuple[float, float], reach: float, order: int
) -> None:
    """Draw a hand from the centre of a dial face, if its reading is determined. On a spiral it ends at the current
    turn.

    reach   radius of the dial on paper [in]
    order   index of the hand's style
    """
    if reading.turned is None:
        return
    scale = face.scale
    tip = place(centre, reach * scale.radius(float(reading.at * scale.way % scale.turns)), reading.at % 1)
    tail = place(centre, -0.12, reading.at % 1)
    look = series_look(order)
    axes.plot(*zip(tail, tip, strict=True), color="white", linewidth=4.0, solid_capstyle="round", zorder=6)
    axes.plot(*zip(centre, tip, strict=True), linewidth=2.2, zorder=6, gid=f"pointer {reading.output}", **look)
    axes.plot(*zip(tail, centre, strict=True), color=look["color"], linewidth=2.2, zorder=6)
    if scale.turns == 1 and len(reading.outline) > _PLAIN:  # a hand that is wider than a line
        along = np.subtract(tip, centre)
        across = np.array([along[1], -along[0]])
        right, left = ([centre + x * along + way * w * across for x, w in reading.outline] for way in (1, -1))
        outline = [*right, *left[::-1]]
        axes.add_patch(Polygon(outline, closed=True, facecolor=look["color"], edgecolor="none", zorder=6))
    if scale.turns > 1 or len(face.pointers) > 1:  # a dot keeps the tip of a hand visible under another hand
        axes.plot(*tip, "o", color=look["color"], markersize=4, zorder=7)


def _reading_text(pointer: Pointer, reading: PointerReading, face: DialPicture, usual: str) -> str:
    """Return the name, position and reading of an output as text.

    usual   sense of rotation that is omitted from the text, such as "clockwise"
    """
    if reading.turned is None:
        return f"{pointer.output}: undetermined"
    scale = face.scale
    where = reading.turned * scale.way % scale.turns
    text = f"at {where if is_short(where, 12) else decimal(where, 6)} turn"
    error = reading.error * scale.way
    if abs(error) > 5e-7:  # turns, below the printed precision of six decimals
        text += f" {'+' if error > 0 else '-'} {abs(error) * 360:.3g}°"
    if face.ball:
        text += f", {50 * (1 - cos(2 * pi * float(reading.at))):.0f} % lit"
    elif face.name and (shown := scale.reading_text(reading.at * scale.way)):  # a plain face has ticks but no cells
        text += f", {shown}"
    way = pointer.text.removesuffix(" as read")
    return f"{pointer.output}: {text}{f', {way}' if way and (way != usual or not pointer.speed) else ''}"
