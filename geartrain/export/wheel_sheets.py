"""Drawings of all wheels of a train: one sheet for each kind of wheel, however often it is needed."""

from __future__ import annotations

import re
from cmath import exp
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import hypot, pi

import numpy as np

from geartrain.scene.solids.flat_drawing import EngravedText, FlatDrawing
from geartrain.scene.solids.wheel_arms import RIM
from geartrain.scene.solids.wheel_blanks import Blank
from geartrain.teeth.outlines.contour import Contour

_LETTER = 0.5  # of the free width of the web: height of letters
_GREATEST = 5.0  # mm
_LETTER_WIDTH = 0.62  # of its height, as letters of this kind are in the mean
_BESIDE = 0.3  # mm between letters and a hole
_SMALLER, _WAYS, _STEPS = (1.0, 0.8, 0.6, 0.45, 0.3, 0.2), 24, 9  # letters, and places for them, that are tried
_CENTRAL = 1e-6  # mm from the axle: that hole is the bore
_RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\.|$)", re.I)  # names that Windows keeps for itself


@dataclass(frozen=True, slots=True)
class WheelSheet:
    """A drawing with the name of its file, without suffix, what it shows, and how thick its sheet is (mm)."""

    file: str
    drawing: FlatDrawing
    parts: tuple[str, ...]
    thickness: float


def wheel_sheets(blanks: Mapping[str, Blank]) -> tuple[WheelSheet, ...]:
    """A sheet for each shape among the blanks; wheels of one shape share it."""
    alike: dict[object, list[Blank]] = {}
    for blank in blanks.values():
        alike.setdefault(_shape(blank), []).append(blank)
    names = file_names(group[0].wheel for group in alike.values())
    return tuple(
        WheelSheet(name, _drawing(group), tuple(blank.wheel for blank in group), group[0].thickness)
        for name, group in zip(names, alike.values(), strict=True)
    )


def file_names(names: Iterable[str]) -> list[str]:
    """Names that every file system takes, all different even where letters' case is one."""
    used: set[str] = set()
    found = []
    for name in names:
        base = re.sub(r"[^\w.+-]+", "-", name).strip("-.")[:80] or "part"
        stem = base = f"part-{base}" if _RESERVED.match(base) else base
        count = 1
        while stem.lower() in used:
            count += 1
            stem = f"{base}-{count}"
        used.add(stem.lower())
        found.append(stem)
    return found


def _shape(blank: Blank) -> object:
    outline = tuple(contour.points.round(6).tobytes() for contour in blank.contours)
    return blank.form, round(blank.thickness, 6), outline


def _drawing(group: list[Blank]) -> FlatDrawing:
    blank = group[0]
    names = ", ".join(each.wheel for each in group)
    what = "pins" if blank.kind == "pins" else "teeth"
    often = f", {len(group)} times" if len(group) > 1 else ""
    title = (
        f"{names}{often}: {blank.teeth} {what}{' inside' if blank.kind == 'ring' else ''}, {blank.form}, module "
        f"{blank.module:.6g} mm, pitch diameter {2 * blank.pitch_radius:.4f} mm, thickness {blank.thickness:.4g} mm"
        + (f", bore {blank.bore:.4g} mm" if blank.bore else "")
        + (f", {blank.arms} arms" if blank.arms else "")
    )
    inner, outer = blank.bore / 2, min(blank.root_radius, blank.tip_radius)
    if blank.kind == "ring":
        inner, outer = blank.root_radius, float(abs(blank.contours[0].points).max())
    elif blank.arms:
        inner = outer - RIM * blank.module  # on the rim: below it there is an arm or nothing
    height = min(_LETTER * (outer - inner), _GREATEST, 1.6 * outer / max(len(names), 1))
    mark = _clear_of(_holes(blank), EngravedText(names, (0.0, (inner + outer) / 2), height), inner, outer)
    return FlatDrawing(title, blank.contours, (Contour.circle(blank.pitch_radius),), (mark,))


def _holes(blank: Blank) -> list[tuple[complex, float]]:
    """Circles that hold the holes beside a wheel's bore: middles and radii (mm); none of a wheel with arms."""
    own = blank.contours[1:] if blank.kind == "external" else blank.contours[2:]
    found = []
    for hole in own if not blank.arms and blank.kind != "pins" else ():
        points = hole.flattened(0.05) @ np.array([1, 1j])
        middle = complex(points.mean())
        if abs(middle) > _CENTRAL:
            found.append((middle, float(abs(points - middle).max())))
    return found


def _clear_of(holes: list[tuple[complex, float]], mark: EngravedText, inner: float, outer: float) -> EngravedText:
    """Letters as they are if they cross no hole; else where there is room for them, the largest that find some."""

    def free(at: complex, along: complex, height: float) -> bool:
        half, tall = _LETTER_WIDTH * height * len(mark.text) / 2, height / 2
        corners = [abs(at + along * complex(x, y)) for x in (-half, 0.0, half) for y in (-tall, tall)]
        if max(corners) > outer or min(corners) < inner:
            return False
        seen = [((middle - at) * along.conjugate(), radius) for middle, radius in holes]
        return all(
            hypot(max(abs(z.real) - half, 0), max(abs(z.imag) - tall, 0)) > radius + _BESIDE for z, radius in seen
        )

    if not holes or free(complex(*mark.at), 1 + 0j, mark.height):
        return mark
    for part in _SMALLER:
        height = part * mark.height
        for step in range(_WAYS):
            out = 1j * exp(-2j * pi * step / _WAYS)
            for away in np.linspace(outer - height / 2, inner + height / 2, _STEPS).tolist():
                if free(out * away, -1j * out, height):
                    at = out * away
                    return EngravedText(mark.text, (at.real, at.imag), height, -360 * step / _WAYS)
    return mark
