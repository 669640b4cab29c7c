"""The errata of F. Sorge's note on ancient gears, recomputed: part of docs/errata.md."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import atan2, cos, degrees, hypot, pi, radians, sin, sqrt

import numpy as np
from sources.sorge import eq_31
from sources.sorge_contacts import FRICTION, contacts, transmission

import geartrain
from geartrain.dynamics.motion.pair_impacts import collision_energies
from geartrain.teeth.triangular.clearance_window import find_window

PRINTED = {
    "3a": ("0.1582",), "3b": ("0.1457",), "4a": ("0.1117",), "4b": ("0.0314", "0.0682"), "5a": ("0.0876", "0.0095"),
    "5b": ("0.0119", "0.0696"),
}  # fmt: skip


def table(header: tuple[str, ...], body: list[tuple[str, ...]]) -> Iterator[str]:
    """A Markdown table."""
    yield "| " + " | ".join(header) + " |"
    yield "|" + "---|" * len(header)
    yield from ("| " + " | ".join(row) + " |" for row in body)
    yield ""


def sorge() -> Iterator[str]:
    """The section of the page."""
    yield from ("## Sorge's note on ancient gears", "")
    yield "`geartrain report sorge-pairs` lists the errata in its last section:"
    yield ""
    errata = geartrain.load("sorge-pairs").declaration.errata
    yield from table(("place", "printed", "right"), [(e.place, e.printed, e.right) for e in errata])
    yield "What shows them:"
    yield ""
    yield from equation_16()
    yield from equation_33()
    yield from equation_31()
    yield from line_of_action()
    yield from equation_26()
    yield from jumps()
    yield from windows()
    yield from impacts()
    yield from equation_25()
    yield from sub_regions()
    yield from best_clearance()
    yield from whole_train()


def equation_16() -> Iterator[str]:
    """The distance of the apices with either root, against the two apices themselves."""
    pair = transmission(48, 96, "1.01")
    sizes, tooth_pair, x = pair.sizes, pair.contact.path.tooth_pair, radians(-5)
    y = tooth_pair.recess_angle(x)
    apart = hypot(sizes.R1 * cos(x) + sizes.R2 * cos(y) - sizes.D, sizes.R1 * sin(x) - sizes.R2 * sin(y))
    square = sizes.D**2 + sizes.R1**2 - 2 * sizes.D * sizes.R1 * cos(x)
    root = sqrt(square - (sizes.R2 * sin(sizes.beta2)) ** 2)
    foot = sizes.R2 * cos(sizes.beta2)
    yield (
        f"**Eq. (16)**, 48/96 at a = 1.01, alpha_1 = -5 deg: the apices are {apart:.6f} R1 apart; the minus gives "
        f"{foot - root:.6f}, the plus {foot + root:.6f}."
    )
    yield ""


def equation_33() -> Iterator[str]:
    """The printed efficiency of recess, along the ideal path."""
    pair = transmission(48, 96, "1.01")
    tooth_pair, sizes = pair.contact.path.tooth_pair, pair.sizes
    x = np.linspace(-sizes.reach1, -1e-9, 20001)
    y, tau = tooth_pair.recess_angle(x, np), tooth_pair.recess_speed(x, np)
    turned = atan2(FRICTION, 1) * np.sign(x)
    cc = np.cos(sizes.beta2 - x - y) * np.cos(sizes.beta2 - y + turned)
    ss = np.sin(x) * np.sin(turned)
    printed, right = (cc + tau * ss) / (cc - ss), (cc - tau * ss) / (cc + ss)
    own = tooth_pair.recess_friction(x, np)
    ours = (1 - FRICTION * own[0] * own[1]) / (1 - FRICTION * own[0] * own[2])
    yield (
        f"**Eq. (33)**, the same pair, recess: as printed the efficiency rises to {printed.max():.3f}; with its "
        f"signs exchanged it is {right.min():.4f} to 1, and differs from equation (11) of [Real teeth](teeth.md) by at "
        f"most {np.abs(right - ours).max():.0e}."
    )
    yield ""


def equation_31() -> Iterator[str]:
    """The driven arm in recess against the moment of a force, at every contact of Figs. 3 to 5."""
    printed, mended = eq_31()
    yield (
        f"**Eq. (31)**: the moment about O2 of a force through the contact, turned by friction, differs from the "
        f"printed arm by up to {100 * printed:.1f} %; with tau below the first product both are equal to "
        f"{'rounding' if mended < 1e-12 else f'{mended:.0e}'}."
    )
    yield ""


def line_of_action() -> Iterator[str]:
    """Which way friction turns the force on the driven wheel, in degrees about the contact, towards O2 positive."""
    body = []
    for phase in ("approach", "recess"):
        for c in contacts(phase):
            turn = np.degrees(np.arctan2((c.force * c.along).sum(axis=0), (c.force * c.normal).sum(axis=0)))
            near, far = ((c.y > 0), (c.y < 0)) if phase == "approach" else ((c.x > 0), (c.x < 0))
            cells = (f"{turn[part].mean():+.2f}" if part.any() else "-" for part in (near, far))
            body.append((f"{c.z1}/{c.z2}, D = {c.D:.4f}", phase, *cells))
    yield "**IV**, line of action: friction turns it by 11.31 deg, towards O2 before the line of centres, away from it"
    yield "after; the note has it towards O2 in approach and in recess. Plane vectors at the contacts of Figs. 3 to 5:"
    yield ""
    yield from table(("pair", "phase", "before the line of centres", "after"), body)


def equation_26() -> Iterator[str]:
    """The jump of Fig. 5a with the -1 outside and inside."""
    pair = transmission(96, 96, "1.01")
    jump = next(each for each in pair.jumps if each.kind == "approach")
    outside = 1 - jump.before / (jump.after + 1) - 1
    yield (
        f"**Eq. (26)**, 96/96 at a = 1.01, entry of approach: with the -1 outside {outside:.4f}, inside "
        f"{jump.value:.4f}; Fig. 5a prints 0.0876."
    )
    yield ""


def jumps() -> Iterator[str]:
    """All printed jumps."""
    train = geartrain.load("sorge-pairs")
    body = []
    for mesh in train.meshes:
        found = mesh.transmission.jumps
        same = [f"{jump.value:.4f}" for jump in found] == list(PRINTED[mesh.name])
        body.append(
            (
                mesh.name,
                ", ".join(f"{jump.kind} {jump.value:.5f}" for jump in found),
                ", ".join(PRINTED[mesh.name]),
                "agrees" if same else "misprint",
            )
        )
    yield "**Figs. 3 to 5**, relative jumps of normal velocity:"
    yield ""
    yield from table(("figure", "computed", "printed", ""), body)


def windows() -> Iterator[str]:
    """What III C says of always one couple, and of back profiles."""
    yield "**III C.** One couple at a time, joined without a break, only within a window of clearance:"
    yield ""
    body = []
    for z1, z2 in ((48, 96), (96, 72), (96, 96), (15, 60), (45, 225), (8, 64)):
        found = find_window(transmission(z1, z2, "1.01").sizes)
        kind = f"{1 + found.run:.5f} ({found.run_kind})"
        body.append(
            (
                f"{z1}/{z2}",
                f"{1 + found.jam:.5f}",
                kind,
                f"{1 + found.reach:.5f}",
                "" if found else "no clearance works",
            )
        )
    yield from table(("pair", "back flanks jam below", "turns up to", "tips touch up to", ""), body)


def impacts() -> Iterator[str]:
    """The energies of one collision, per J2 w1^2."""
    (jump,) = transmission(48, 96, "1.01").jumps
    handed, lost = (jump.after**2 - jump.before**2) / 2, (jump.after - jump.before) ** 2 / 2
    yield (
        f"**IV**, 48/96 at a = 1.01, in J2 w1^2: the printed work hands {handed:.5f} to the driven side; {lost:.5f} is "
        f"dissipated, and the driver does {handed + lost:.5f} at each pitch of {degrees(2 * pi / 48):.1f} deg."
    )
    yield ""


def equation_25() -> Iterator[str]:
    """The jump of Fig. 3a by the printed equation, alpha_2 read at either end of the path, and at both."""
    pair = transmission(48, 96, "1.01")
    tooth_pair, sizes = pair.contact.path.tooth_pair, pair.sizes
    (interval,) = pair.intervals
    x = np.array([interval.start, interval.end])
    y = tooth_pair.recess_angle(x, np)

    def jump(first: float, last: float) -> float:
        upper, lower = (
            sizes.D * cos(sizes.beta2 - own) / cos(sizes.beta2 - at - other) - sizes.R1
            for own, at, other in ((y[0], x[0], first), (y[1], x[1], last))
        )
        return float(1 - upper / lower)

    yield (
        f"**Eq. (25)** leaves alpha_2 in two cosines without an index. 48/96 at a = 1.01: with alpha_2i in both "
        f"{jump(y[0], y[0]):.4f}, with alpha_2e in both {jump(y[1], y[1]):.4f}, each with its own {jump(*y):.4f}; "
        "Fig. 3a prints 0.1582."
    )
    yield ""


SMALL = ("1.001", "1.003", "1.006", "1.009", "1.0111", "1.0113", "1.0115", "1.0117", "1.0118", "1.0193", "1.025")


def sub_regions() -> Iterator[str]:
    """How the sub-regions of 96/96 share a pitch, and where the piece astride is born and is left alone."""
    yield "**V**, 96/96: neither sub-region narrows until it vanishes. Shares of a pitch, by clearance:"
    yield ""
    body = []
    for clearance in SMALL:
        found = shares(clearance)
        body.append((clearance, *(f"{share:.3f}" if share else "-" for share in found)))
    yield from table(("a", "approach apart", "astride", "recess apart"), body)
    born, alone = edge(lambda found: found[1] > 0), edge(lambda found: found[0] == found[2] == 0)
    whole = [shares(f"{a:.7f}") for a in np.linspace(1.001, born - 1e-7, 51)]
    minimum, most = (f(each for found in whole for each in (found[0], found[2])) for f in (min, max))
    yield (
        f"Each keeps {minimum:.3f} to {most:.3f} of a pitch until, at a = {born:.6f}, a third piece "
        f"is born astride the "
        f"matching position; it eats both, and is alone from a = {alone:.6f}."
    )
    yield ""


def shares(clearance: str) -> tuple[float, float, float]:
    """Parts of a pitch of 96/96: contact in approach by itself, astride the matching position, in recess by itself."""
    pair = transmission(96, 96, clearance)
    apart = {"approach": 0.0, "recess": 0.0}
    astride = 0.0
    for each in pair.intervals:
        width = abs(each.width) / pair.period
        ends = each.end if each.phase == "approach" else each.start
        if abs(ends - pair.sizes.matching) < 1e-9:
            astride += width
        else:
            apart[each.phase] += width
    return apart["approach"], astride, apart["recess"]


def edge(true: Callable[[tuple[float, float, float]], bool]) -> float:
    """The clearance from which something is true of the shares."""
    low, high = 1.005, 1.02
    while high - low > 1e-10:
        middle = (low + high) / 2
        low, high = (low, middle) if true(shares(f"{middle:.12f}")) else (middle, high)
    return high


def best_clearance() -> Iterator[str]:
    """Where 96/96 loses least by sliding, and where by collisions."""
    rows = [("printed as best", 1.025)]
    rows += [("least friction", minimum_of(lost)), ("least dissipated by collisions", minimum_of(dissipated))]
    yield "**V**, 96/96: a = 1.025 is not best, neither for friction (0.2) nor for collisions:"
    yield ""
    body = [(name, f"{a:.7g}", f"{100 * lost(a):.3f} %", f"{dissipated(a):.2e}") for name, a in rows]
    yield from table(("", "a", "lost by sliding", "dissipated at each pitch, in J2 w1^2"), body)


def lost(a: float) -> float:
    """Part of the power that sliding takes from 96/96."""
    return 1 - transmission(96, 96, f"{a:.12f}").efficiency_mean()


def dissipated(a: float) -> float:
    """What the collisions of a pitch dissipate, over J2 w1^2."""
    return collision_energies(transmission(96, 96, f"{a:.12f}").speed_leaps(), 1.0, 1.0)[1]


def minimum_of(what: Callable[[float], float]) -> float:
    """The clearance at which something is least: a scan of the pair's window, then finer ones around the best."""
    low, high = 1.001, 1.0265
    for _ in range(6):
        grid = np.linspace(low, high, 41)
        best = int(np.argmin([what(float(a)) for a in grid]))
        low, high = float(grid[max(best - 1, 0)]), float(grid[min(best + 1, 40)])
    return (low + high) / 2


def whole_train() -> Iterator[str]:
    """What a train of such pairs loses, against the order of 10 % of the conclusion."""
    train = geartrain.load("pennestri-2002-teeth")
    body = []
    for link in ("5", "17", "19"):
        found = train.driven(link, "2").efficiency
        body.append((link, f"{100 * (1 - float(found)):.1f} %" if found else "locks"))
    yield "**VI**: losses of the order of 10 % or less are those of a pair, not of a mechanism. The train of Pennestri"
    yield "et al. with these teeth (`pennestri-2002-teeth`), driven at its crank:"
    yield ""
    yield from table(("load on link", "lost by sliding"), body)
