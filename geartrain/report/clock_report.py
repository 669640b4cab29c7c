"""Section of the report on a clock: whether its drive suffices, and how well it keeps time."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees
from typing import TYPE_CHECKING

from geartrain.report.document import Section, Table, titled

if TYPE_CHECKING:
    from geartrain.dynamics.clock_rate import Timekeeping

_PER_DAY = 86400.0


def timekeeping_section(found: Timekeeping) -> Section:
    """Return a section on the energy, the amplitude and the rate of a clock in one state."""
    lines = [f"{verdict}."] if (verdict := _verdict(found)) else []
    lines.append(
        "Friction of pivots is included only as declared by `bearing`. Rates are for a constant amplitude; friction on "
        "the dead faces, backlash of the crutch and air drag are not modelled."
    )
    return Section(titled(found.state, "timekeeping"), lines, (Table(("quantity", "value"), list(_rows(found))),))


def _verdict(found: Timekeeping) -> str:
    if found.efficiency <= 0:
        return f"The clock does not go: friction takes all of the torque at '{found.source}'"
    if found.goes is None:
        return ""
    needed = _torque(found, found.minimum_torque) if found.minimum_weight is None else f"{found.minimum_weight:.4g} kg"
    return f"The clock {'goes' if found.goes else 'does not go'}: at least {needed} is needed at '{found.source}'"


def _torque(found: Timekeeping, size: float | None) -> str:
    return "" if size is None else f"{size:.6g} {'N' if found.slides else 'N m'}"


def _rows(found: Timekeeping) -> Iterator[tuple[str, str]]:
    kind = "force" if found.slides else "torque"
    yield f"{kind} at {found.source}", _torque(found, found.torque)
    yield f"power at {found.source}", f"{1e6 * found.power:.6g} uW"
    yield "efficiency up to the escape wheel", f"{found.efficiency:.6f}"
    if found.lost_in_bearings:
        yield "lost in pivots", f"{100 * found.lost_in_bearings:.4g} %"
    yield "energy per beat", f"{1e6 * found.beat_energy:.6g} uJ"
    if found.amplitude is not None:
        yield "amplitude of the pendulum", f"{degrees(found.amplitude):.5g} deg"
    if found.minimum_torque is not None:
        yield f"minimum {kind} at {found.source}", _torque(found, found.minimum_torque)
    if found.minimum_weight is not None:
        yield "minimum weight", f"{found.minimum_weight:.4g} kg"
    if found.descent is not None:
        yield "descent of the weight", f"{1000 * _PER_DAY * found.descent:.6g} mm/day"
    if found.going_time is not None:
        yield "going time", f"{found.going_time / _PER_DAY:.5g} days"
    rates = (
        ("rate, circular error", found.circular, "s/day"),
        ("rate, escapement error", found.escapement, "s/day"),
        ("rate, thermal expansion", found.thermal, "s/day per kelvin"),
    )
    yield from ((what, f"{rate:+.4g} {unit}") for what, rate, unit in rates if rate is not None)
