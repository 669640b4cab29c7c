"""A page on one pin in a slot."""

from __future__ import annotations

from math import degrees, isnan
from typing import TYPE_CHECKING, Any

from geartrain.report.document import Document, Section, Table, figure

if TYPE_CHECKING:
    from geartrain.pins.laws import PinLaw


def pin_document(law: PinLaw, drives: str) -> Document:
    """Mean ratio, amplitude, extreme speeds and friction of one coupling."""
    least, most = law.speed_range()
    kind = "encloses" if law.ratio else "leaves out"
    lead = [
        f"The {drives} drives. The pin's circle, of radius {figure(law.r)}, {kind} the slot's axis at {figure(law.e)}: "
        f"the mean ratio is {law.ratio}.",
    ]
    rows = [
        ("amplitude", f"{law.amplitude:.9g} rad", f"{degrees(law.amplitude):.9g} deg"),
        ("error, rms", f"{law.error_moments()[1]:.9g} rad", f"{degrees(law.error_moments()[1]):.9g} deg"),
        ("speed ratio, least", figure(least), ""),
        ("speed ratio, greatest", figure(most), ""),
    ]
    if law.friction:
        driver, load = law.efficiency_mean(), law.efficiency_at_constant_load()
        rows.append((f"efficiency at friction {law.friction:g}, mean", _share(driver), "at constant driver torque"))
        rows.append(("", _share(load), "at constant load torque"))
    table = Table(("quantity", "value", ""), rows)
    return Document("Pin in a slot", lead, [Section("Law of motion", (), (table,))])


def _share(efficiency: float) -> str:
    """An efficiency; `-` where friction locks, or no work is done on a constant load."""
    return "-" if isnan(efficiency) else f"{efficiency:.9f}"


def pin_data(law: PinLaw) -> dict[str, Any]:
    """One coupling as plain data with stable keys; angles in rad."""
    least, most = law.speed_range()
    low, high = law.error_range()
    mean, at_load = law.efficiency_mean(), law.efficiency_at_constant_load()
    return {
        "pin_radius": law.r,
        "offset": law.e,
        "speed_ratio": {"mean": float(law.ratio), "exact": str(law.ratio), "min": least, "max": most},
        "amplitude": law.amplitude,
        "transmission_error": {"peak_to_peak": high - low, "rms": law.error_moments()[1], "mean": 0.0},
        "efficiency": {
            "friction": law.friction,
            "mean": None if isnan(mean) else mean,
            "at_constant_load": None if isnan(at_load) else at_load,
        },
    }
