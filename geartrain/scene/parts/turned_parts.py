"""Arbors, pipes, studs and pillars as bodies of revolution, which consist of bands of constant radius."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import pi

import numpy as np

from geartrain.scene.parts.arbor_columns import (
    COLLAR,
    HEAD,
    HEAD_OVER,
    SHAKE,
    AxisBearing,
    AxisColumn,
    ColumnMember,
    FramePlaces,
)
from geartrain.scene.parts.processes import Process
from geartrain.scene.parts.stack_discs import Point
from geartrain.scene.solids.triangle_solids import SIDES, Solid, joined, lathed

_SAME = 1e-9


@dataclass(frozen=True, slots=True)
class Band:
    """Section of a turned part between two heights along its axis, with constant outer and inner radius [mm]."""

    low: float
    high: float
    radius: float
    bore: float = 0.0


@dataclass(frozen=True, slots=True)
class TurnedPart:
    """Turned part of a link, such as an arbor or a pillar: a body of revolution about an axis of the stack."""

    link: str
    name: str
    kind: str
    """Kind of part, such as arbor, pipe, stud, collar, spacer, collet, pillar, post, drum, foot, pin, barrel or bob."""
    at: Point
    """Position of the part's axis in the stack [mm]."""
    bands: tuple[Band, ...]
    """Bands from the lowest to the highest; a pinion cut from the same piece occupies a gap between two bands."""
    joint: str = ""
    """Part to which this part is joined, or method of joining."""
    through: tuple[str, ...] = ()
    """Names of the wheels and turning plates that have a hole for the part."""

    @property
    def ends(self) -> tuple[float, float]:
        """Heights of the lowest and the highest point of the part [mm]."""
        return self.bands[0].low, self.bands[-1].high

    @property
    def diameter(self) -> float:
        """Diameter of the round stock from which the part is turned [mm]."""
        return 2 * max(band.radius for band in self.bands)

    @property
    def volume(self) -> float:
        """Volume of the part [mm3], not including pinions that are cut from the same piece."""
        return sum(pi * (band.radius**2 - band.bore**2) * (band.high - band.low) for band in self.bands)

    def sections(self) -> list[list[Band]]:
        """Return the bands in groups; gaps for pinions separate the groups."""
        found = [[self.bands[0]]]
        for before, band in pairwise(self.bands):
            if band.low > before.high + _SAME:
                found.append([])
            found[-1].append(band)
        return found

    def solid(self) -> Solid:
        """Return the surface of the part as triangles, with the axis of the part along z."""
        turn = 2 * pi * np.arange(SIDES) / SIDES
        circle, solids = np.column_stack([np.cos(turn), np.sin(turn)]), []
        for section in self.sections():
            # a corner on the axis is one vertex
            rows = [np.column_stack([r * circle, np.full(SIDES, z)])[: None if r else 1] for r, z in profile(section)]
            solids.append(lathed(rows))
        return joined(solids)


def profile(bands: Sequence[Band]) -> list[tuple[float, float]]:
    """Return the corners (radius, height) of half an axial section [mm], counter-clockwise, none of them collinear."""
    outside = [corner for band in bands for corner in ((band.radius, band.low), (band.radius, band.high))]
    inside = [corner for band in bands[::-1] for corner in ((band.bore, band.high), (band.bore, band.low))]
    corners = [*outside, *inside]
    # bands of equal radius give collinear corners, and so triangles without area
    bent = (
        (here, before, after)
        for here, before, after in zip(corners, [corners[-1], *corners[:-1]], [*corners[1:], corners[0]], strict=True)
    )
    return [
        here
        for here, before, after in bent
        if here != before and not any(before[k] == here[k] == after[k] for k in (0, 1))
    ]


def column_parts(
    column: AxisColumn, places: FramePlaces, frame: str, process: Process, cut: frozenset[str]
) -> Iterator[TurnedPart]:
    """Yield the arbor or stud, the pipes and the collars of an axis; pinions in `cut` are one part with their arbor."""
    members = column.members
    if column.is_stud or not members or members[0].inner:
        if column.is_stud:
            yield _stud(column, places, frame, process)
    elif column.bearing is AxisBearing.BRIDGE:
        yield from _in_bridge(column, members[0], places, process, cut)
        members = members[1:]
    else:
        yield from _core(column, members[0], places, process, cut)
        members = members[1:]
    for each in members:
        whole = [Band(each.low, each.high, each.outer / 2, each.inner / 2)]
        bands, name = tuple(without(whole, each, cut)), rod_name(column, each)
        yield TurnedPart(each.link, name, "pipe", column.at, bands, _carries(each))


def rod_name(column: AxisColumn, member: ColumnMember) -> str:
    """Return the name of an arbor or a pipe, including the name of a wheel if a link has several pipes on an axis."""
    if not member.inner:
        return f"{member.link} arbor"
    first = next(each for each in column.members if each.link == member.link and each.inner)
    name = f"{member.link} pipe" + (f" on {column.axis}" if member.fixed else "")
    return name + (f" at {member.discs[0].name}" if member is not first or member.discs[0].apart else "")


def without(bands: Sequence[Band], member: ColumnMember, cut: frozenset[str]) -> list[Band]:
    """Return the bands of a turned part, interrupted at the pinions that are cut from the same piece."""
    found = list(bands)
    for disc in member.discs:
        if disc.name in cut:
            found = [
                Band(low, high, band.radius, band.bore)
                for band in found
                for low, high in ((band.low, min(band.high, disc.low)), (max(band.low, disc.high), band.high))
                if high - low > _SAME
            ]
    return found


def _carries(member: ColumnMember) -> str:
    return "carries " + ", ".join(disc.name for disc in member.discs)


def _core(
    column: AxisColumn, member: ColumnMember, places: FramePlaces, process: Process, cut: frozenset[str]
) -> Iterator[TurnedPart]:
    """Yield an arbor between two plates, with a pivot in each plate, or with a collar where it passes through."""
    low, high = places.back[1] + SHAKE / 2, places.front[0] - SHAKE / 2
    thick, thin = column.core / 2, column.pivot / 2
    below, above = crosses(member, places.back), crosses(member, places.front)
    bands = [] if below else [Band(places.back[0], low, thin)]
    bands.append(Band(member.low if below else low, member.high if above else high, thick))
    bands += [] if above else [Band(high, places.front[1], thin)]
    yield TurnedPart(
        member.link, f"{member.link} arbor", "arbor", column.at, tuple(without(bands, member, cut)), _carries(member)
    )
    for passes, face, way in ((below, low, 1), (above, high, -1)):
        ends = sorted((face, face + way * COLLAR))
        free = all(each is member or each.high <= ends[0] or ends[1] <= each.low for each in column.members)
        # a collar replaces the shoulder of an arbor without pivots
        if passes and free:
            ring = Band(ends[0], ends[1], thick + COLLAR, thick + process.press / 2)
            side = "back" if way > 0 else "front"
            joint = f"on the arbor, {process.joint}"
            yield TurnedPart(member.link, f"{member.link} {side} collar", "collar", column.at, (ring,), joint)


def _in_bridge(
    column: AxisColumn, member: ColumnMember, places: FramePlaces, process: Process, cut: frozenset[str]
) -> Iterator[TurnedPart]:
    """Yield an arbor of uniform thickness that is supported by a bridge, with a collar on each side of the bridge."""
    radius = column.core / 2
    bands = without([Band(column.low, column.high, radius)], member, cut)
    yield TurnedPart(member.link, f"{member.link} arbor", "arbor", column.at, tuple(bands), _carries(member))
    inner, outer = places.back[0] - SHAKE / 2, places.front[1] + SHAKE / 2
    for side, ends in (("lower", (inner - COLLAR, inner)), ("upper", (outer, outer + COLLAR))):
        ring = Band(*ends, radius + COLLAR, radius + process.press / 2)
        name, joint = f"{member.link} {side} collar", f"on the arbor, {process.joint}"
        yield TurnedPart(member.link, name, "collar", column.at, (ring,), joint)


def crosses(member: ColumnMember, plate: tuple[float, float]) -> bool:
    """Return True if an arbor or pipe extends beyond both faces of a plate."""
    return member.low < plate[0] and plate[1] < member.high


def _stud(column: AxisColumn, places: FramePlaces, frame: str, process: Process) -> TurnedPart:
    """Return a stud fixed in one plate; its head retains the turning parts unless another stud is on its end."""
    plate = places.back if column.bearing is AxisBearing.BACK_STUD else places.front
    radius = column.core / 2
    low, high = column.low, column.high
    up = high > plate[1]
    shaft, head = ((low, high - HEAD), (high - HEAD, high)) if up else ((low + HEAD, high), (low, low + HEAD))
    bands = [Band(*shaft, radius), Band(*head, radius + HEAD_OVER)]
    if column.topped:
        bands = [Band(low, high, radius)]
    joint = f"one piece with {column.on} stud" if column.on else process.joint
    return TurnedPart(frame, f"{column.axis} stud", "stud", column.at, tuple(bands if up else bands[::-1]), joint)
