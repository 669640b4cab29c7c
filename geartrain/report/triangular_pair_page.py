"""A page on one pair of wheels with triangular teeth: sizes, clearance, path, law, collisions and losses."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, isfinite, pi
from typing import TYPE_CHECKING

from geartrain.report.document import Section, Table, figure
from geartrain.teeth.pair_results import friction_lock_at_speed
from geartrain.teeth.rubbed_transmission import pair_friction
from geartrain.teeth.triangular.triangular_mesh import explain_clearance, explain_friction_lock
from geartrain.teeth.triangular.triangular_transmission import contact_course

if TYPE_CHECKING:
    from geartrain.dynamics.motion.pair_impacts import PairOperation
    from geartrain.teeth.triangular.clearance_window import ClearanceWindow
    from geartrain.teeth.triangular.triangular_mesh import TriangularMesh
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission


def triangular_sections(mesh: TriangularMesh, operation: PairOperation | None) -> Iterator[Section]:
    """What there is to tell; of teeth that never touch, sizes and clearance only."""
    law, window = mesh.law, mesh.window
    yield _sizes(law)
    if window is not None:
        yield _clearance(law, window)
    if law.intervals:
        yield from (_path(law), _course(mesh), _law(law), _collisions(law), _losses(mesh), *_impacts(law, operation))


def triangular_verdict(mesh: TriangularMesh) -> str:
    """Whether the pair can turn, why not, and what to do."""
    law, found = mesh.law, mesh.law.verdict
    words = [f"Verdict: {found.kind}: {found.text}."]
    if not found:
        why, fix = explain_clearance(law, mesh.window)
        words += [f"Why: {why}." if why else "", f"What to do: {fix}."]
    elif mesh.losses.locks:
        what, why, fix = _lock(mesh)
        words = [f"Verdict: friction locks: {what}.", f"Why: {why}.", f"What to do: {fix}."]
    return " ".join(word for word in words if word)


def _sizes(law: TriangularTransmission) -> Section:
    sizes = law.sizes
    names = [
        f"{name}, a ring" if sign < 0 else name for name, sign in zip(("driver", "driven"), sizes.signs, strict=True)
    ]
    wheels = (
        (names[0], sizes.z1, sizes.beta1, sizes.R1, sizes.depths[0], sizes.flanks[0], sizes.p1),
        (names[1], sizes.z2, sizes.beta2, sizes.R2, sizes.depths[1], sizes.flanks[1], sizes.p2),
    )
    rows = [
        (name, str(z), _deg(beta), figure(R), figure(h), figure(e), _deg(pitch))
        for name, z, beta, R, h, e, pitch in wheels
    ]
    header = ("wheel", "teeth", "half angle", "tip radius", "depth", "flank", "pitch")
    text = f"Centre distance {figure(sizes.D)}, in the unit of radii, depths and flanks (Eqs. 1 to 3). Angles in deg."
    return Section("Sizes", (text,), (Table(header, rows),))


def _clearance(law: TriangularTransmission, window: ClearanceWindow) -> Section:
    sizes = law.sizes
    turns = (
        f"These teeth turn from {window.jam_factor:.6f} ({window.jam_kind}) to {window.run_factor:.6f} "
        f"({window.run_kind})"
        if window
        else f"No clearance works: {window.jam_kind} up to {window.jam_factor:.6f}, {window.run_kind} from "
        f"{window.run_factor:.6f}"
    )
    lines = [
        f"Clearance factor {sizes.clearance_factor:.9g}. {turns}; beyond {window.reach_factor:.6f} tips never touch."
    ]
    if sizes.ring:
        depth = sizes.delta / min(sizes.depths)
        lines.append(
            f"A ring is deepest at the maximum distance. The tips overlap by {depth:.4g} of the smaller depth."
        )
    if law.intervals:
        play = law.verdict.play
        arc = play * sizes.D * sizes.z2 / sizes.pitch_sum
        lines.append(
            f"Least play of the back flanks over a pitch: {degrees(play):.6g} deg of the driven wheel, an arc of "
            f"{arc:.6g} on its pitch circle."
        )
    return Section("Clearance", lines)


def _path(law: TriangularTransmission) -> Section:
    sizes = law.sizes
    ideal = (
        f"Ideally a couple of teeth meets from alpha_1 = {_deg(sizes.reach1)} to {_deg(-sizes.reach1)} deg (Eq. 4), "
        f"its flanks matching at {_deg(sizes.matching)} deg (Eq. 10): approach before, recess after. The real path is "
        f"one pitch, {_deg(sizes.p1)} deg; alpha_1 decreases with time."
    )
    rows = []
    for interval in law.intervals:
        first, last = law.contact.speed(interval, interval.start), law.contact.speed(interval, interval.end)
        share = interval.width / sizes.p1
        rows.append(
            (interval.phase, _deg(interval.start), _deg(interval.end), f"{share:.4f}", figure(first), figure(last))
        )
    header = ("phase", "from alpha_1", "to alpha_1", "pitches", "tau at first", "tau at last")
    return Section("Path of contact", (ideal,), (Table(header, rows),))


def _course(mesh: TriangularMesh) -> Section:
    """Speed ratio, instant centre and moment arms at the ends of every interval and between them."""
    found = contact_course(mesh.law, friction=pair_friction(mesh.wheels))
    columns = (found.speed_ratio, found.instant_centre, found.driver_arm, found.driven_arm, found.efficiency)
    rows = [
        (phase, _deg(x), _deg(y), *(figure(value) if isfinite(value) else "-" for value in values))
        for phase, x, y, *values in zip(
            found.phases,
            found.alpha1.tolist(),
            found.alpha2.tolist(),
            *(each.tolist() for each in columns),
            strict=True,
        )
    ]
    header = ("phase", "alpha_1", "alpha_2", "tau", "O1C", "b1", "b2", "efficiency")
    text = (
        "O1C: the instant centre of the relative motion, on the line of centres, from the driver's axis (Eqs. 11, 18). "
        "b1, b2: arms of the force about the driver's and the driven axis (Eqs. 28 to 31); efficiency is tau b2/b1. "
        "Lengths as under Sizes, angles in deg."
    )
    return Section("Over the pitch", (text,), (Table(header, rows),))


def _law(law: TriangularTransmission) -> Section:
    least, most = law.speed_range()
    low, high = law.error_range()
    lag, rms = law.error_moments()
    mean = float(law.ratio)
    rows = [
        ("speed ratio, mean", f"{law.ratio} = {figure(law.ratio)}", ""),
        ("speed ratio, least", figure(least), f"{(least / mean - 1) * 100:+.3f} %"),
        ("speed ratio, greatest", figure(most), f"{(most / mean - 1) * 100:+.3f} %"),
        ("transmission error, peak to peak", f"{high - low:.9g} rad", f"{degrees(high - low):.9g} deg"),
        ("transmission error, rms", f"{rms:.9g} rad", f"{degrees(rms):.9g} deg"),
        ("transmission error, mean", f"{lag:.9g} rad", f"{degrees(lag):.9g} deg"),
    ]
    text = (
        "Transmission error: driven angle less its mean motion, positive where the driven wheel is ahead; counted from "
        "the driver's tooth on the line of centres."
    )
    return Section("Law of motion", (text,), (Table(("quantity", "value", ""), rows),))


def _collisions(law: TriangularTransmission) -> Section:
    rows = [
        (jump.kind, _deg(jump.alpha1), figure(jump.before), figure(jump.after), f"{jump.value:.5f}")
        for jump in law.jumps
    ]
    header = ("begins", "at alpha_1", "tau before", "tau after", "jump")
    text = "Jump: 1 - before/after, the leap of normal velocity over the driver's (Eqs. 22, 25, 26, 27)."
    return Section("Collisions", (text,), (Table(header, rows),))


def _lock(mesh: TriangularMesh) -> tuple[str, str, str]:
    """What is said of friction that locks."""
    declared = mesh.wheels.friction_law
    if declared is None:
        return explain_friction_lock(mesh.law)
    fault = friction_lock_at_speed(declared.law, mesh.law.locking_friction)
    return fault.what, fault.why, fault.fix


def _losses(mesh: TriangularMesh) -> Section:
    law = mesh.losses
    if not mesh.rubs:
        return Section("Friction", ("No friction is given: nothing is lost by sliding.",))
    if not mesh.tells_losses:
        return Section("Friction", (f"{mesh.friction_words}.",))
    if law.locks:
        what, why, _ = _lock(mesh)
        return Section("Friction", (f"{what}: {why}.",))
    lines = [
        f"{mesh.friction_words}. Sliding efficiency: mean {law.efficiency_mean():.9f} at constant "
        f"driver torque (Eq. 34), {law.efficiency_at_constant_load():.9f} at constant load torque, least "
        f"{law.efficiency_least():.6f}.",
    ]
    if isfinite(law.locking_friction):
        lines.append(f"From a friction of {law.locking_friction:.6g} on these teeth lock.")
    return Section("Friction", lines)


def _impacts(law: TriangularTransmission, operation: PairOperation | None) -> Iterator[Section]:
    from geartrain.dynamics.motion.pair_impacts import find_pair_impacts

    found = None if operation is None else find_pair_impacts(law, operation)
    if found is None or operation is None:
        return
    lines = []
    if found.work is not None:
        watts = found.work * (operation.rate or 0) * law.sizes.z1
        lines.append(
            f"At {operation.rate:g} turns of the driver a second the collisions of one pitch hand "
            f"{found.handed:.6g} J to the driven side, dissipate {found.dissipated:.6g} J, and cost the driver their "
            f"sum, {found.work:.6g} J, or {watts:.6g} W. The source counts the first as lost; inelastic teeth lose "
            "the second."
        )
        lines.append(
            f"The driven inertia stays in contact as tau falls if the load torque is at least {found.least_load:.6g} "
            "N m."
        )
    if found.void is not None:
        lines.append(
            f"With a load torque of {operation.load:g} N m the quasi-static law is void above {found.void:.6g} "
            f"turns of the driver a second ({2 * pi * found.void:.6g} rad/s)."
        )
    if not lines:
        lines.append(
            "Give a rate for the impacts, or a load torque for the speed above which the quasi-static law is void."
        )
    yield Section("Impacts", lines)


def _deg(angle: float) -> str:
    return f"{degrees(angle):.6g}" if isfinite(angle) else "none"
