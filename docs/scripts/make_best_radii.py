"""Write docs/best-radii.md: the radii of triangular teeth that lose least, by counts, and a law for makers.

`python docs/scripts/make_best_radii.py --data` finds them anew and keeps them in docs/data/best_radii.json (some
minutes); without it the page is written from what is kept.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping
from math import exp, log, pi
from pathlib import Path

import numpy as np

from geartrain.errors import GearTrainError
from geartrain.workshop import ToothSizes
from geartrain.workshop.sizes.size_design import equal_depth_radii
from geartrain.workshop.sizes.size_search import SizeSearch

DOCS = Path(__file__).resolve().parents[1]
PAGE, DATA = DOCS / "best-radii.md", DOCS / "data" / "best_radii.json"
COUNTS = (10, 12, 15, 20, 24, 30, 40, 48, 60, 80, 96, 120)
STEEPEST = 5  # of a ratio of counts
SHOWN = ((12, 24), (15, 30), (15, 60), (20, 60), (24, 48), (48, 24), (48, 48), (48, 96), (60, 15), (96, 24), (96, 96))
FRICTION, HALF_ANGLE, WINDOW = 0.2, pi / 6, 0.5
Row = dict[str, float]


def design(z1: int, z2: int, radii: float) -> ToothSizes:
    """A pair as the page has it."""
    return ToothSizes((z1, z2), radii, WINDOW, (HALF_ANGLE, HALF_ANGLE), FRICTION)


def loss(z1: int, z2: int, radii: float) -> float | None:
    """What a pair loses; None where it does not turn."""
    made = design(z1, z2, radii)
    return made.loss if made.runs else None


def find() -> list[dict[str, float | None]]:
    """The best radii of all pairs of counts."""
    rows: list[dict[str, float | None]] = []
    for z1 in COUNTS:
        for z2 in COUNTS:
            if not 1 / STEEPEST <= z1 / z2 <= STEEPEST:
                continue
            try:
                best = SizeSearch(design(z1, z2, 1.0), {"radii": (0.8, 1.25)}).minimum("loss")
            except GearTrainError:
                continue
            equal = equal_depth_radii(z1, z2, (HALF_ANGLE, HALF_ANGLE))
            rows.append(
                {
                    **{"z1": z1, "z2": z2, "radii": round(best.radii, 6), "loss": best.loss},
                    **{"equal_depth": loss(z1, z2, equal), "pitch_true": loss(z1, z2, 1.0)},
                }
            )
    return rows


def fit(rows: list[Row]) -> tuple[float, float]:
    """A and B of the law, by least squares of the logarithm."""
    matrix = np.array([[-(1 / row["z1"] - 1 / row["z2"]), -((1 / row["z1"] + 1 / row["z2"]) ** 2)] for row in rows])
    found = np.linalg.lstsq(matrix, np.array([log(row["radii"]) for row in rows]), rcond=None)[0]
    return round(float(found[0]), 2), round(float(found[1]), 2)


def transmission(z1: float, z2: float, A: float, B: float) -> float:
    """The radii of the law."""
    return exp(-A * (1 / z1 - 1 / z2) - B * (1 / z1 + 1 / z2) ** 2)


def page(rows: list[Row]) -> Iterator[str]:
    """The page, line by line."""
    A, B = fit(rows)
    pairs = [(int(row["z1"]), int(row["z2"])) for row in rows]
    off = [transmission(*pair, A, B) / row["radii"] - 1 for pair, row in zip(pairs, rows, strict=True)]
    spent = {pair: loss(*pair, transmission(*pair, A, B)) for pair in pairs}
    times = [(spent[pair] or 1.0) / row["loss"] for pair, row in zip(pairs, rows, strict=True)]
    large = [at for at, row in enumerate(rows) if min(row["z1"], row["z2"]) >= 20]
    equal = [row["equal_depth"] / row["loss"] for row in rows if row["equal_depth"] is not None]
    true = [row["pitch_true"] / row["loss"] for row in rows if row["pitch_true"] is not None]
    share = [row["loss"] / (1 / row["z1"] + 1 / row["z2"]) for row in rows]
    worst, worst_large = (100 * max(abs(off[at]) for at in some) for some in (range(len(rows)), large))
    counts = f"{COUNTS[0]} to {COUNTS[-1]} teeth, ratios up to {STEEPEST}"
    yield "# Radii for triangular teeth"
    yield ""
    yield f"Written by `python docs/scripts/make_best_radii.py` from {len(rows)} pairs of {counts}, whose best radii"
    yield "were found by the search of [section 11](teeth.md#11-the-best-sizes): half angle 30 deg, the middle of the"
    yield f"window, friction {FRICTION}. The first wheel drives."
    yield ""
    yield rf"$$ \frac{{R_2/R_1}}{{z_2/z_1}} = \exp\left[-{A}\left(\frac1{{z_1}} - \frac1{{z_2}}\right) -"
    yield rf"{B}\left(\frac1{{z_1}} + \frac1{{z_2}}\right)^2\right] \tag{{1}} $$"
    yield ""
    yield f"gives the outer radii that lose least to {worst:.1f} %, to {worst_large:.1f} % where both wheels have 20"
    yield f"teeth or more. What a pair loses with them is {np.median(times):.3f} times the least in the middle of all"
    yield f"pairs, {max(times):.2f} times at worst. Pitch-true radii, {np.median(true):.1f} and {max(true):.1f} times,"
    yield f"and equal depth, {np.median(equal):.1f} and {max(equal):.1f} times, are far behind. In words: mark out"
    yield "pitch circles in the ratio of the teeth, and then make the wheel with fewer teeth a little larger outside,"
    yield "or the other a little smaller. At other half angles and clearances ask"
    yield "`geartrain mesh Z1 Z2 --form triangular --objective loss`."
    yield ""
    yield from table(rows, spent, (A, B))
    yield ""
    equal_driver = 100 * (exp(B * (2 / 48) ** 2) - 1)
    involute = pi * FRICTION / 2
    yield WHY.replace("FACTOR", str(A)).replace("LARGER", f"{equal_driver:.2f}")
    yield ""
    yield f"A pair so made loses {min(share):.2f} to {max(share):.2f} times $1/z_1 + 1/z_2$, where an involute pair"
    yield f"with arcs of half a pitch on either side loses $\\pi f/2 = {involute:.2f}$ times: ancient teeth of the"
    yield "right size are as good as any that slide over one pitch."


def table(
    rows: list[Row], spent: Mapping[tuple[int, int], float | None], constants: tuple[float, float]
) -> Iterator[str]:
    """Some pairs: the best radii, and what they lose with radii by rules."""
    yield "| teeth | best | law (1) | least loss | by the law | pitch-true | equal depth |"
    yield "|---|---|---|---|---|---|---|"
    for row in rows:
        pair = int(row["z1"]), int(row["z2"])
        if pair in SHOWN:
            losses = (row["loss"], spent[pair], row["pitch_true"], row["equal_depth"])
            cells = " | ".join("does not turn" if each is None else f"{100 * each:.2f} %" for each in losses)
            yield f"| {pair[0]}/{pair[1]} | {row['radii']:.4f} | {transmission(*pair, *constants):.4f} | {cells} |"


WHY = r"""## Why

Friction costs least where a tooth slides least, as near to the line of centres as a pitch allows: half of the
path before it and half after it. Count $x$, the driver's angle before the line, from $p_1/2$ to $-p_1/2$,
with $p_i = 2\pi/z_i$. In approach the driven apex, on its way across the line of centres, is at $R_2$ from
its own axis and at $R_1 - \delta$ from the driver's, $\delta$ being the overlap of the tip circles; in recess
the driver's apex is at $R_1$ and $R_2 - \delta$. There, by the law of gearing,

$$ \tau_a = \frac{R_1 - \delta}{R_2}, \qquad \tau_r = \frac{R_1}{R_2 - \delta}, \qquad
\frac{d\tau}{dx} \approx \tau(1 + \tau)\tan\beta \tag{2} $$

in both, by (7) and (9) of [real teeth](teeth.md#3-one-couple-of-teeth) at $y = 0$ and $x = 0$. Over the pitch
the driven wheel has to turn by $p_2$. The slopes before and after the line cancel, half of the pitch goes at
$\tau_a$ and half at $\tau_r$:

$$ \frac{z_1}{z_2} = \frac{\tau_a + \tau_r}{2} \approx \frac{R_1}{R_2}\left[1 - \frac\delta2\left(\frac1{R_1} -
\frac1{R_2}\right)\right], \qquad
\frac{R_2/R_1}{z_2/z_1} \approx 1 - \frac\delta m\left(\frac1{z_1} - \frac1{z_2}\right) \tag{3} $$

with $R_i \approx m z_i/2$. In the middle of the window teeth of 30 deg overlap by $\delta \approx 1.2\,m$,
about half their depth, and (3) explains the form of (1), its sign and most of the factor FACTOR: 48/96 has $1
- 1.2/96 = 0.987$, and 0.982 is best. The rest is that flanks match, and approach becomes recess, a little
before the line of centres, more so with few teeth. The second term is of the same kind, and is why even equal
wheels are better off with a driver LARGER % larger at 48 teeth."""


def main() -> None:
    """Write the page, with `--data` from radii found anew."""
    if "--data" in sys.argv[1:]:
        text = ",\n".join(json.dumps(row) for row in find())
        DATA.write_text(f"[\n{text}\n]\n", encoding="utf-8")
    rows = json.loads(DATA.read_text(encoding="utf-8"))
    PAGE.write_text("\n".join(page(rows)) + "\n", encoding="utf-8")
    print("wrote docs/best-radii.md")


if __name__ == "__main__":
    main()
