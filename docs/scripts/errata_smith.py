"""The errata of W. D. Smith's note on optimal gears, recomputed: part of docs/errata.md."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import cos, pi, radians, sin
from typing import Any

import numpy as np
from sources import smith as note
from sources.smith import BEVEL, SPUR

from geartrain.teeth.conjugate import optimal_sides as forms
from geartrain.teeth.conjugate.path_of_contact import PathContact, PathOfContact
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

FRACTIONS = (0.1, 0.25, 0.4, 0.5)  # of a pitch after the pitch point


def table(header: Sequence[str], body: Sequence[Sequence[str]]) -> Iterator[str]:
    """A Markdown table."""
    yield "| " + " | ".join(header) + " |"
    yield "|" + "---|" * len(header)
    yield from ("| " + " | ".join(row) + " |" for row in body)
    yield ""


def involute(pitch: PitchSurfaces) -> PathContact:
    """A 20 degree involute in recess."""
    side = forms.involute(pitch.p / 2, radians(20))
    return PathOfContact(pitch, side, side).at(np.array(FRACTIONS) * pitch.p)


def heads(c: PathContact, R: float, bevel: bool) -> tuple[Any, Any]:
    """r of gear 1 and the sine of its psi, by the triangle of its centre, pitch point and contact."""
    if bevel:
        r = np.arccos(np.cos(R) * np.cos(c.d) - np.sin(R) * np.sin(c.d) * c.sin_psi)
        return r, (np.cos(R) - np.cos(r) * np.cos(c.d)) / (np.sin(r) * np.sin(c.d))
    r = np.sqrt(c.d**2 + R**2 + 2 * R * c.d * c.sin_psi)
    return r, (r**2 + c.d**2 - R**2) / (2 * r * c.d)


def smith() -> Iterator[str]:
    """The section of the page."""
    yield from ("## Smith's note on optimal gears, 1993", "")
    yield "The note sets up tooth shapes of least friction, uniform stress and uniform temperature. Its symbols: r the"
    yield "distance from the gear's centre, s that from the pitch point, phi the angle of the normal to the line of"
    yield "centres, psi_1 that between radius and profile. Theory without the errors: [Tooth shapes](shapes.md)."
    yield ""
    yield from table(
        ("place", "printed", "right"),
        [
            ("(8), first", "cos R1 cos s + sin R1 sin s cos phi", "minus"),
            ("(11), first", "s^2 + R1^2 - 2 R1 s cos phi", "plus, as its own second formula has it"),
            ("(22), (23)", "the upper sign of the root", "the lower one; (56) and (63) are made with it"),
            ("(33), (38)", "cos phi = (r1/R1) cos psi_1, and with sines of r1 and R1", "sin phi"),
            ("(35)", "cos A1 = ... - sin(s - c1) sin R1 cos phi_1", "plus; (36) and (37) are right"),
            ("(42), (44), (45)", "c + s", "c - s with the signed s of (23); on the own dedendum both are the same"),
            ("(51), (52)", "(R1/R2 + R2/R1) G kappa mu", "(1/R1 + 1/R2) G kappa mu; bevel cot R1 + cot R2"),
            ("section 16", "trains lose less than a pair of large ratio", "no longer, with (51) as it must be"),
            ("(56)", "-2 r^3 r'^3 H - r^5 r' H - r r'^5 H", "+ H Q (r^2 + r'^2)^2"),
            ("(63)", "a square over a sum of twelve terms", "linear in r''; its sign is turned, too"),
            ("(64)", "a differential equation of the fourth order", "of the second, with a closed solution"),
            ("footnote 6", "45 deg makes involutes most efficient", "at one height of tooth; at one arc all are equal"),
            ("section 6", "cycloids supposedly have less friction than involutes", "at the same arcs they have more"),
            (
                "section 15",
                "n contacts that share the force leave W as it is",
                "each place of a tooth bears less",
            ),
            (
                "section 21",
                "uniform stress and temperature plausibly have the least greatest stress and temperature",
                "not without a bound on the pressure angle",
            ),
        ],
    )
    yield "What shows them, on 24 and 36 teeth with 20 degree involutes, so many pitches after the pitch point:"
    yield ""
    yield from places()
    yield from long_ones()
    yield from losses()
    yield from racks()
    yield from profiles()
    yield from claims()


def places() -> Iterator[str]:
    """Equations (8), (11), (33), (22), (23), (44)."""
    s, b = involute(SPUR), involute(BEVEL)
    R1 = SPUR.R1
    r, sine = heads(s, R1, False)
    rb, _ = heads(b, BEVEL.R1, True)
    cosine = np.sqrt(1 - sine**2)
    minus = np.cos(BEVEL.R1) * np.cos(b.d) + np.sin(BEVEL.R1) * np.sin(b.d) * b.sin_psi - np.cos(rb)
    root = np.sqrt(R1**2 - (r * cosine) ** 2)
    c = 1 / s.k1
    A2 = r**2 + c**2 - 2 * r * c * sine

    def crawl(at: Any) -> Any:
        return (R1**2 + at**2 - A2) * c / (2 * R1 * at**2)

    yield from table(
        ("", *(f"{part:g} p" for part in FRACTIONS)),
        [
            numbers("(8), bevel: cos r1 as printed less cos r1", minus, ".5f"),
            numbers("(11): r1^2 less r1^2 as printed", 4 * R1 * s.d * s.sin_psi, ".3f"),
            numbers("(33): cos phi as printed", r / R1 * cosine, ".4f"),
            numbers("cos phi", s.sin_psi, ".4f"),
            numbers("(23), upper sign: s", r * sine + root, ".4f"),
            numbers("lower sign", r * sine - root, ".4f"),
            numbers("s", s.d, ".4f"),
            numbers("(44), c + s: speed over the true one", crawl(c + s.d) / s.U1, ".3f"),
            numbers("with c - s", crawl(c - s.d) / s.U1, ".3f"),
        ],
    )


def numbers(name: str, values: Any, form: str) -> tuple[str, ...]:
    """A row."""
    return (name, *(format(float(value), form) for value in values))


def long_ones() -> Iterator[str]:
    """(56) and (63) over the truth, by the slips that make them."""
    body = []
    sides = {
        "involute": forms.involute(SPUR.p / 2, radians(20)),
        "uniform stress, 20 deg": forms.uniform_stress(SPUR, SPUR.A, SPUR.B, SPUR.p / 2, radians(20)),
    }
    for name, side in sides.items():
        c = PathOfContact(SPUR, side, side).at(np.array(FRACTIONS) * SPUR.p)
        r, sine = heads(c, SPUR.R1, False)
        c1, wrong = 1 / c.k1, -r / SPUR.R1 * np.sqrt(1 - sine**2)  # what (33) makes of cos phi with cot psi = -r'/r
        turned = 1 / ((SPUR.A + SPUR.B) / wrong - 1 / (c1 - c.d)) - c.d
        A2 = r**2 + c1**2 - 2 * r * c1 * sine
        slow = (SPUR.R1**2 + (c1 + c.d) ** 2 - A2) * c1 / (2 * SPUR.R1 * (c1 + c.d) ** 2)
        body.append(numbers(f"(56), {name}", (1 / c1 + 1 / turned) / c.kr, ".3f"))
        body.append(numbers(f"(63), {name}", -c.U1 / slow, ".3f"))
    yield "**(56) and (63)** over what they should be. The first is what (33) makes of (55), the second what c + s"
    yield "makes of (45), with its sign turned; in 40 digits both come out as printed:"
    yield ""
    yield from table(("", *(f"{part:g} p" for part in FRACTIONS)), body)


def losses() -> Iterator[str]:
    """(51) on three pairs, and section 16."""
    body = []
    for z1, z2 in ((24, 24), (24, 72), (24, 240)):
        loss = pi / 2 * (1 / z1 + 1 / z2)
        body.append(
            (f"{z1}/{z2}", f"{loss:.5f}", f"{loss / (z1 / z2 + z2 / z1):.5f}", f"{loss / (2 / z1 + 2 / z2):.5f}")
        )
    yield "**(51)** divides the loss of involutes (over mu, modules for G); the form factor must come out the same:"
    yield ""
    yield from table(("pair", "loss", "by R1/R2 + R2/R1", "by 1/R1 + 1/R2"), body)
    one, three = 1 + 1 / 1000, 3 * (1 + 1 / 10)
    printed = (1000 + 1 / 1000) / (3 * (10 + 1 / 10))
    yield (
        f"**Section 16**, 1000 to 1: three stages of 10 to 1 are said to lose {printed:.0f} times less than one; with "
        f"the same pinion they lose {three / one:.2f} times as much."
    )
    yield ""


def racks() -> Iterator[str]:
    """Footnote 6."""
    body = []
    for tilt in (14.5, 20.0, 30.0, 45.0, 60.0):
        psi = radians(tilt)
        arc = 1.0 / (sin(psi) * cos(psi))
        same = forms.involute(1.0, psi)
        x = float(same.travel(np.array(same.end)))
        body.append((f"{tilt:g}", f"{arc**2 / 2:.4f}", f"{x**2 / 2:.4f}"))
    yield "**Footnote 6**, J of a rack, height or arc being 1 module:"
    yield ""
    yield from table(("pressure angle (deg)", "at one height", "at one arc"), body)


def profiles() -> Iterator[str]:
    """Equations with an erratum, on finished profiles: as printed, and mended."""
    rows: tuple[tuple[str, tuple[float, float]], ...] = (
        ("(8), first, bevel", (note.eq_8(1.0), note.eq_8(-1.0))),
        ("(11), first", (note.eq_11(-1.0), note.eq_11(1.0))),
        ("(22), bevel", (note.eq_22(1.0), note.eq_22(-1.0))),
        ("(23)", (note.eq_23(1.0), note.eq_23(-1.0))),
        ("(33)", note.cosine_of_phi("spur")),
        ("(35), bevel", (note.spherical_centres(1, -1.0), note.spherical_centres(1))),
        ("(38), bevel", note.cosine_of_phi("bevel")),
        ("(42), bevel", note.speed_of_contact("bevel")),
        ("(44), (45)", note.speed_of_contact("spur")),
        ("(51), spread of the form factor", note.losses("spur")),
        ("(52), the same, bevel", note.losses("bevel")),
        ("(56)", note.long_one(56)),
        ("(63)", note.long_one(63)),
        ("(64), by how much the third and fourth derivative of r change it", note.order_of_64()),
    )
    yield "**On finished profiles** of 24 and 36 teeth, spur and bevel, from points of the two teeth alone: the"
    yield "greatest difference of both sides of an equation, in parts of its size, as printed and mended:"
    yield ""
    mended = ["below 1e-6" if value[1] < 1e-6 else f"{value[1]:.0e}" for _, value in rows]
    body = [(name, f"{value[0]:.2g}", last) for (name, value), last in zip(rows, mended, strict=True)]
    yield from table(("equation", "as printed", "mended"), body)


def claims() -> Iterator[str]:
    """Sections 6, 15 and 21."""
    yield f"**Section 6**, cycloids of 24 and 36 teeth: {note.cycloids_rub().text} as involutes."
    yield ""
    yield f"**Section 15**, work of one engagement of involutes of 24 and 36 teeth, {note.shared_work().text}."
    yield ""
    yield "**Section 21**, 24 and 36 teeth, half a pitch to either side. Stress: "
    yield f"{note.minimum_height('stress').text}. Heat: {note.minimum_height('temperature').text}."
    yield ""
