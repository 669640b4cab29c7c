"""Torque over some turns of the input, as sections of a page: extremes, energies, losses, where it locks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geartrain.numerics.exact import percent_text
from geartrain.report.document import Section, Table, cut, figure

if TYPE_CHECKING:
    from geartrain.dynamics import PlaceInRun, TorqueCycle

_LEAST = 1e-12  # of all that is lost: less is rounding


def cycle_sections(found: TorqueCycle) -> Iterator[Section]:
    """Torque at the crank over a run, energies, and what each pair, pin and bearing takes."""
    head = "Torque over a turn" if found.state is None else f"State {found.state}: torque over a turn"
    lines = [f"Verdict: {found.verdict.kind}: {found.verdict.text}."]
    lines += [f"Left out: {each}: {each.why}." for each in found.left_out]
    if found.turns is None:
        yield Section(head, lines)
        return
    lines.append(_run(found))
    lines += _shares(found)
    lines += _efficiency(found)
    lines += _remarks(found)
    yield Section(head, lines, (_torques(found), *_locked(found)))
    if found.energy is not None:
        title = "Energy over the run" if found.state is None else f"State {found.state}: energy over the run"
        yield Section(title, (_energy_unit(found),), (_energies(found), *_parts(found)))


def turns_text(turns: float) -> str:
    """`1 turn`, `2.5 turns`."""
    return f"{turns:g} turn{'' if turns == 1 else 's'}"


def _run(found: TorqueCycle) -> str:
    assert found.turns is not None
    text = f"Torque at '{found.link}' over {turns_text(found.span)} of the input, at {len(found.turns)} positions"
    text += ", corners and both sides of jumps among them"
    if found.period is not None:
        whole = found.span / found.period
        text += f"; everything repeats after {turns_text(found.period)}"
        text += "" if whole >= 1 - 1e-9 else ", of which this is a part"
    return text + "."


def _shares(found: TorqueCycle) -> Iterator[str]:
    """Where the train locks, is held from both sides, or may turn in several ways."""
    shares = {
        "no torque balances: the train locks": found.locked_share,
        "loads and the crank both put power in, and all of it is lost": found.held_share,
        "several patterns of power flow balance; the torque is of the one that loses least": found.ambiguous_share,
    }
    for what, share in shares.items():
        if share:
            yield f"In {percent_text(share)} of the run {what}."


def _efficiency(found: TorqueCycle) -> Iterator[str]:
    if found.efficiency:
        yield f"Efficiency, energy out over energy in: {figure(found.efficiency, 10)}."
    elif found.energy is not None and found.energy.net_in > 0:
        yield "No energy is taken out on the whole: all that is put in is lost."


def _remarks(found: TorqueCycle) -> Iterator[str]:
    if found.loses_most is not None and len(found.parts) > 1:
        yield f"Most is lost in {found.loses_most}."
    if changes := {name: count for name, count in found.flank_changes.items() if count}:
        words = ", ".join(f"{name} {count} times" for name, count in changes.items())
        yield f"The torque changes its sense, and play is crossed, at {words}."
    if found.recirculating:
        words = ", ".join(f"{figure(share, 4)} times at {name}" for name, share in found.recirculating.items())
        yield f"More power passes than is put in: {words}."
    if not found.complete:
        yield "Not all patterns of power flow were tried."


def _torques(found: TorqueCycle) -> Table:
    unit = f" ({found.unit})" if found.unit else ""
    rows = [("mean", figure(found.mean, 9), "", "")]
    for name, extreme in (("greatest", found.greatest), ("least", found.least), ("starting", found.starting)):
        if extreme is None:
            rows.append((name, "-", "", ""))
        else:
            days = "" if extreme.days is None else figure(extreme.days, 7)
            rows.append((name, figure(extreme.torque, 9), figure(extreme.turns, 9), days))
    wanted = 4 if any(row[3] for row in rows) else 3
    header = (f"torque at {found.link}", unit.strip(" ()") or "torque", "at turn", "day")
    return Table(header[:wanted], [row[:wanted] for row in rows])


def _locked(found: TorqueCycle) -> Iterator[Table]:
    if found.locked:
        rows = [(_place(start), _place(end)) for start, end in found.locked]
        yield Table(("locked from turn", "to turn"), cut(rows))


def _place(place: PlaceInRun) -> str:
    day = "" if place.days is None else f" (day {figure(place.days, 7)})"
    return f"{figure(place.turns, 9)}{day}"


def _energy_unit(found: TorqueCycle) -> str:
    if found.newton_metres:
        return "Energies in J."
    return "Energies in the unit of the loads times radians."


def _energies(found: TorqueCycle) -> Table:
    assert found.energy is not None
    energy = found.energy
    whole = energy.put_in + energy.loads_put_in
    amounts = {
        f"put in at {found.link}": energy.put_in,
        f"given back at {found.link}": energy.returned,
        "put in by loads": energy.loads_put_in,
        "taken out by loads": energy.taken_out,
        "lost in teeth": energy.mesh,
        "lost in pins": energy.pin,
        "lost in bearings": energy.bearing,
    }
    rows = [
        (name, figure(value, 9), _share(value, whole)) for name, value in amounts.items() if abs(value) > _LEAST * whole
    ]
    return Table(("over the run", "energy", "of all put in"), rows)


def _parts(found: TorqueCycle) -> Iterator[Table]:
    """What each pair, pin and bearing takes, the greatest loss first."""
    assert found.energy is not None
    lost = found.energy.lost
    ranked = sorted(found.parts.items(), key=lambda each: -each[1].loss)
    rows = [
        (
            name,
            figure(part.loss if part.loss > _LEAST * lost else 0.0, 7),
            _share(part.loss, lost) if part.loss > _LEAST * lost else "",
            "" if part.kind == "bearing" else figure(part.passed, 7),
            "" if part.kind == "bearing" else str(part.flank_changes),
        )
        for name, part in ranked
        if part.loss > _LEAST * lost or part.passed
    ]
    if rows:
        yield Table(("where", "lost", "of all lost", "passed on", "flank changes"), cut(rows))


def _share(part: float, whole: float) -> str:
    return percent_text(part / whole) if whole else "-"
