"""Data and document on the torques, power flow and losses of a train, and on its torque over some turns."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from geartrain.numerics.exact import as_float, percent_of_text, percent_text, watts_text
from geartrain.numerics.results import Key, Result
from geartrain.report.document import Document, Section, Table, cut, figure, filled_table, titled
from geartrain.wings import WingResult, has_wing, wing

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import PowerFlow, TorqueCycle, Torques, TorqueVerdict
    from geartrain.dynamics.torques.power_flow import PowerLoss
    from geartrain.dynamics.torques.torque_results import DrivenWay
    from geartrain.dynamics.turn.torque_cycle import PlaceInRun
    from geartrain.train import Train


# -------------------------------------------------------------------------------------------------------------- figures


class Impact(NamedTuple):
    """Power that is dissipated by the impacts of a pair."""

    impact: float
    """Power that is dissipated by the impacts of the pair [W]."""


@dataclass(frozen=True)
class LossFigures:
    """Power loss of a pair or bearing. The power dissipated by the pair's impacts is included if it is known."""

    KEYS = (Key("", "loss"), Key("", "collisions"))

    loss: PowerLoss
    collisions: Impact | None


@dataclass(frozen=True)
class DrivenFigures:
    """Efficiency of a train that is driven in one direction, and the verdict on this direction."""

    KEYS = (
        *("verdict", Key("efficiency", to=as_float), Key("exact", "exact_efficiency")),
        Key("neglected", "way.torques.neglected"),
    )

    way: DrivenWay

    @property
    def verdict(self) -> TorqueVerdict:
        """Verdict on whether the train can be driven in this direction of power flow."""
        return self.way.torques.verdict

    @property
    def efficiency(self) -> Fraction | float | None:
        """Power output divided by power input; None if the efficiency is not determined."""
        return self.way.torques.efficiency if self.verdict else None

    @property
    def exact_efficiency(self) -> Fraction | None:
        """Efficiency as an exact fraction; None if it was computed as a float."""
        return self.efficiency if isinstance(self.efficiency, Fraction) else None


class DrivenWays(NamedTuple):
    """Efficiency of a train when driven from the input (`forward`) and from the output (`backward`)."""

    forward: DrivenFigures
    backward: DrivenFigures


@dataclass(frozen=True)
class TorqueFigures(Result):
    """Torques, power flow and losses of a train in one state."""

    KEYS = (Key("", "torques"), "drives", "watts_per_unit", "losses", "flow", "belt_pulls")

    torques: Torques
    drives: DrivenWays | None
    """Efficiencies in both directions; None unless power enters at exactly one link and leaves at exactly one link."""
    watts_per_unit: float | None
    """Watts per unit of power (torque unit times speed unit); None if torques or speeds are numbers without a unit."""
    in_newton_metres: bool
    """True if torques are in N m, False if they are in the unit of the declared loads."""
    flow: PowerFlow
    impact_power: Mapping[str, float]
    """Power that impacts dissipate [W], by pair; empty unless inertias and a rate are declared."""
    belt_pulls: Mapping[str, float]
    """Tight minus slack tension at the driven pulley [N], by row of a belt; empty without units."""

    @property
    def losses(self) -> tuple[LossFigures, ...]:
        """Power loss of each pair and bearing."""
        struck = {name: Impact(power) for name, power in self.impact_power.items()}
        return tuple(
            LossFigures(loss, struck.get(loss.node.name) if loss.node.kind == "pair" else None)
            for loss in self.flow.shares
        )


@dataclass(frozen=True)
class TorqueReport(Result):
    """Torque report of a train: torques, power flow and losses in each requested state."""

    PAGE = "report.torque_report:describe_torques"

    name: str
    """Name of the train."""
    title: str
    """Title of the train."""
    states: tuple[TorqueFigures, ...]
    """Torques, power flow and losses of each state, in the requested order."""
    over_turn: TorqueCycle | None = None
    """Torque over some revolutions of the input in one state; None if it was not requested."""
    friction_trials: Annotated[Any, WingResult("workshop.monte_carlo.friction_trials", "FrictionTrials")] | None = None
    """Results of torque analyses with random friction; None if they were not requested."""


def collect_torque_report(
    train: GearTrain, found: Sequence[Torques], over_turn: TorqueCycle | None = None, friction_trials: Any = None
) -> TorqueReport:
    """Return the torque report of a train in one or more states."""
    states = tuple(collect_torques(train, each) for each in found)
    return TorqueReport(train.name, train.declaration.title, states, over_turn, friction_trials)


def collect_torques(train: GearTrain, found: Torques) -> TorqueFigures:
    """Return the torques, the power flow, and the efficiency in both directions, of a train in one state."""
    from geartrain.dynamics.torques.power_flow import find_power_flow, watts_per_unit
    from geartrain.dynamics.torques.train_torques import drive_both_ways

    declared, state, ways = train.declaration, found.state, drive_both_ways(train.mechanics, found.state)
    impacts: Mapping[str, Any] = {}
    if train.declaration.has_inertia and has_wing("simulation"):
        impacts = wing("simulation.contacts.separation_rate").find_tooth_impacts(train.mechanics, state)
    return TorqueFigures(
        found,
        DrivenWays(*map(DrivenFigures, ways)) if ways else None,
        watts_per_unit(declared, declared.case(state)),
        declared.has_torque_units(state),
        find_power_flow(found),
        {pair: impact.power for pair, impact in impacts.items()},
        dict(_belt_pulls(declared, found)) if declared.has_torque_units(state) else {},
    )


def _belt_pulls(declared: Train, found: Torques) -> Iterator[tuple[str, float]]:
    """Yield each belt and the difference of its tensions [N]: torque on the driven pulley divided by pitch radius."""
    for belt in declared.couplings:
        if belt.kind != "belt" or any(size.unit is None for size in belt.lengths):
            continue
        for row in belt.rows(declared.wheels) if any(True for _ in belt.lengths) else ():
            if (pair := found.pairs.get(row.id)) is not None and not pair.loose:
                driven = int(pair.driver == row.driven)
                diameter = dict(zip(belt.ends, belt.lengths, strict=True))[(row.driven, row.driver)[driven]]
                yield row.id, abs(float(2 * pair.torques[driven] / diameter.base))


# ----------------------------------------------------------------------------------------------------------------- page


_UNITS = "Torques are in the unit of the loads. Power is torque times speed in the train's unit"
_UNITS_IN_WATTS = "Torques are in N m. Power is torque times speed in real time"
_SIGNS = (
    ", positive into the train; for a pair, relative to its carrier. Torques of brakes and locks act on the links that "
    "they hold."
)


def describe_torques(found: TorqueReport) -> Document:
    """Return a document on torques: in each state and, if requested, over some revolutions and in friction trials."""
    sections = [section for each in found.states for section in torque_sections(each)]
    if found.over_turn is not None:
        sections += cycle_sections(found.over_turn)
    if found.friction_trials is not None:
        sections += wing("workshop.monte_carlo.friction_trials").trial_sections(found.friction_trials)
    summary = [f"Train '{found.name}'. {_units(found.states)}"]
    return Document(f"Torques of {found.name}", summary, sections)


def torques_document(found: Torques | TorqueCycle) -> Document | None:
    """Return the document of `geartrain torques` for one state; None if the train of the result is not known."""
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Torques

    if found._declaration is None:
        return None
    train = GearTrain(found._declaration)
    if isinstance(found, Torques):
        return describe_torques(collect_torque_report(train, [found]))
    return describe_torques(collect_torque_report(train, [train.torques(found.state)], found))


def loaded_sections(found: Sequence[TorqueFigures]) -> Iterator[Section]:
    """Yield sections on the torques in each loaded state of a train. The first section explains the units."""
    sections = (section for each in found for section in torque_sections(each))
    for at, section in enumerate(sections):
        yield section if at else replace(section, paragraphs=(_units(found), *section.paragraphs))


def torque_sections(figures: TorqueFigures) -> Iterator[Section]:
    """Yield two sections on one state: the verdict, links and pairs, and then the power flow and losses."""
    found, flow, state = figures.torques, figures.flow, figures.torques.state
    head = titled(state, "torques")
    lines = [f"Verdict: {found.verdict.kind}: {found.verdict.text}."]
    if found.verdict.kind == "undecided" and found.verdict.candidates:
        lines.append(f"Candidates for `solve_for`: {', '.join(found.verdict.candidates)}.")
    lines += [f"Not included: {each}: {each.why}." for each in found.neglected]
    lines += _both_directions(figures.drives)
    if not found.verdict:
        yield Section(head, lines)
        return
    amounts = _Amounts(figures)
    efficiency, circulating = found.efficiency, found.circulating
    if efficiency is not None and circulating is not None:
        kept = f"efficiency {figure(efficiency, 6)}{uncounted_words(found)}" if efficiency else "no power is taken out"
        lines.append(
            f"Power in {amounts.text(found.power_in, 6)}, lost {amounts.text(found.loss, 6)}, {kept}; "
            f"the maximum power through a pair is {figure(circulating, 5)} times the power in."
        )
    if found.bearing_loss:
        needed = ", ".join(f"at '{link}' {amounts.torque(link, found.external[link])}" for link in found.requested)
        lines.append(f"Torque needed, with the friction of bearings: {needed}{uncounted_words(found)}.")
    if any(each.load is not None for each in found.bearings):
        lines.append(_LOADED)
    lines += [
        f"The reaction to the torque on '{link}' acts on '{base}'." for link, (base, _) in found.reactions.items()
    ]
    if found.overrunning:
        slips = ", ".join(f"{name} at {figure(slip, 6)}" for name, slip in found.overrunning.items())
        lines.append(f"One-way clutches that overrun, without torque and loss: {slips}.")
    tables = [_links(found, amounts), *_held(found, amounts), _pairs(found, amounts)]
    tables += _bearings(found, amounts)
    if figures.belt_pulls:
        rows = [(name, f"{pull:.6g}") for name, pull in figures.belt_pulls.items()]
        tables.append(Table(("belt", "pull, tight side minus slack side (N)"), rows))
    yield Section(head, lines, tuple(tables))
    parts = tuple(_loops(flow, amounts)), tuple(_losses(flow, amounts, figures.impact_power))
    if any(parts):
        yield Section(titled(state, "power flow"), *parts)


_LOADED = "Loads of bearings follow from declared positions of axes; without axial forces, bending and tilting."


class _Amounts:
    """Converter of powers and torques to strings, in W and N m if the train declares units."""

    def __init__(self, found: TorqueFigures) -> None:
        self.watts = found.watts_per_unit
        self.unit, self.force = (" N m", " N") if found.in_newton_metres else ("", "")
        self.sliding = found.torques.arms

    def text(self, power: Fraction, digits: int = 6) -> str:
        return figure(power, digits) if self.watts is None else watts_text(float(power) * self.watts)

    def torque(self, link: str, torque: Fraction) -> str:
        return self.plain(torque, True) if link in self.sliding else f"{figure(torque, 6)}{self.unit}"

    def plain(self, torque: Fraction, force: bool) -> str:
        """Return a string with a torque without its unit, or, if `force` is True, with a force and its unit."""
        return f"{figure(torque, 6)}{self.force if force else ''}"


def _units(found: Sequence[TorqueFigures]) -> str:
    real = [each.watts_per_unit is not None for each in found if each.torques.verdict]
    # watts only if all states have units, because the sentence applies to all
    return (_UNITS_IN_WATTS if real and all(real) else _UNITS) + _SIGNS


def _links(found: Torques, amounts: _Amounts) -> Table:
    rows = [
        (
            link + (" (solved for)" if link in found.requested else ""),
            amounts.plain(torque, link in amounts.sliding),
            figure(found.speeds[link], 6) if link in found.speeds else "free",
            amounts.text(found.powers[link], 6) if link in found.speeds else "open",
        )
        for link, torque in found.external.items()
    ]
    return Table(("link", "torque", "speed", "power"), rows)


def _held(found: Torques, amounts: _Amounts) -> Iterator[Table]:
    """Yield a table of brakes and locks, and of the torques that they exert on the links they hold."""
    rows = []
    for held in found.held:
        by_link = dict.fromkeys(held.links, "open")
        by_link |= {link: amounts.plain(each, link in amounts.sliding) for link, each in (held.by_link or {}).items()}
        torques = list(by_link.values())
        kind = "brake" if len(held.links) == 1 else "lock"
        name = f"{kind} {held.clutch}" if held.clutch else kind
        name += f" (for {' and '.join(held.cause)})" if held.cause else ""
        rows.append((name, ", ".join(held.links), torques[0], torques[1] if torques[1:] else ""))
    if rows:
        yield Table(("held by", "link", "torque on it", "on the second"), rows)


def uncounted_words(found: Torques) -> str:
    """Return a suffix to an efficiency that lists the effects it neglects; an empty string if it neglects none."""
    uncounted = ", ".join(map(str, found.uncounted))
    return f" without {uncounted}" if uncounted else ", mean over a turn" if found.neglected else ""


def _pairs(found: Torques, amounts: _Amounts) -> Table:
    rows = [
        (
            pair.id + (" (shared)" if pair.loose else ""),
            pair.driver or ("open" if pair.power is None else "idle"),
            *(amounts.plain(pair.torques[at], pair.forces[at]) for at in (0, 1, -1)),
            "open" if pair.power is None else amounts.text(pair.power),
            "open" if pair.power is None else amounts.text(pair.loss),
        )
        for pair in found.pairs.values()
    ]
    return Table(("pair", "driver", "torque on first", "on second", "on carrier", "power", "loss"), rows)


def _bearings(found: Torques, amounts: _Amounts) -> Iterator[Table]:
    """Yield a table of the bearings whose friction depends on the bearing load."""
    loaded = [each for each in found.bearings if each.load is not None]
    rows = [(each.link, each.carrier, figure(each.load, 6), amounts.plain(abs(each.torque), False)) for each in loaded]
    if rows:
        yield Table(("bearing of", "in", "load (N)", "friction torque"), rows)


# ------------------------------------------------------------------------------------------------------ flow and losses


def _loops(flow: PowerFlow, amounts: _Amounts) -> Iterator[str]:
    """Yield a sentence on each loop of recirculating power: its amount, and the pairs and shafts that carry it."""
    if flow.loops:
        yield "Here power is torque times absolute speed, so that it is balanced at every shaft and pair."
    for loop in flow.loops:
        part = percent_of_text(loop.power / flow.power_in, "the power in") if flow.power_in else "no power in"
        yield (
            f"{amounts.text(loop.power)} circulates, {part}: through pairs {', '.join(loop.pairs)} and shafts "
            f"{', '.join(loop.shafts)}."
        )


def _losses(flow: PowerFlow, amounts: _Amounts, impact_power: Mapping[str, float]) -> Iterator[Table]:
    """Yield a table of the losses of each pair and bearing and of their total, with columns for losses of impacts."""
    if not flow.losses and not impact_power:
        return
    struck = {node: impact_power[node.name] for node in flow.nodes if node.kind == "pair" and node.name in impact_power}
    rows = []
    for node in dict.fromkeys((*flow.losses, *struck)):
        name = node.name if node.kind == "pair" else f"bearing of {node.name}"
        rows.append((name, *_loss_row(flow, amounts, flow.losses.get(node, Fraction(0)), struck.get(node))))
    # subtotals are shown only if pairs and bearings both have losses
    teeth = sum((loss for node, loss in flow.losses.items() if node.kind == "pair"), Fraction(0))
    if 0 < teeth < flow.loss:
        sums = {"all pairs": teeth, "all bearings": flow.loss - teeth}
        rows += [(name, *_loss_row(flow, amounts, lost, None)) for name, lost in sums.items()]
    rows.append(("total", *_loss_row(flow, amounts, flow.loss, sum(impact_power.values()) if impact_power else None)))
    header: tuple[str, ...] = ("where", "lost", "of power in", "of all lost")
    if impact_power:
        header = ("where", "sliding", "of power in", "of all sliding", "impact", "of power in")
    yield Table(header, cut([row[: len(header)] for row in rows]))


def _loss_row(flow: PowerFlow, amounts: _Amounts, lost: Fraction, struck: float | None) -> tuple[str, ...]:
    """Return the loss `lost` with its percentages of input power and total loss, and the impact power `struck`."""
    parts = (percent_text(lost / whole) if whole else "-" for whole in (flow.power_in, flow.loss))
    if struck is None:
        return (amounts.text(lost), *parts, "", "")
    whole = float(flow.power_in) * (amounts.watts or 0.0)
    return (amounts.text(lost), *parts, watts_text(struck), percent_text(Fraction(struck / whole)) if whole else "-")


def summary_text(torques: Torques) -> str:
    """Return the efficiency and the losses by cause as text, or why the efficiency is not determined."""
    if not torques.verdict or not torques.power_in:
        return torques.verdict.text
    lost = {"teeth": torques.loss - torques.bearing_loss, "bearings": torques.bearing_loss}
    named = [f"{percent_text(power / torques.power_in)} is lost in {where}" for where, power in lost.items() if power]
    out = percent_text(1 - torques.loss / torques.power_in)
    uncounted = [f"not included: {', '.join(map(str, torques.neglected))}"] if torques.neglected else []
    return "; ".join([f"efficiency {out}", *named, *uncounted])


# ------------------------------------------------------------------------------------------------------ there and back


def _both_directions(drives: DrivenWays | None) -> Iterator[str]:
    for way in drives or ():
        torques, first, last = way.way
        efficiency = torques.efficiency
        if torques.verdict.kind == "self-locking":
            yield f"'{last}' cannot be driven from '{first}': the train locks."
        elif torques.verdict.kind == "overrunning":
            yield f"'{last}' cannot be driven from '{first}': {' and '.join(torques.verdict.candidates)} overruns."
        elif efficiency is not None:
            word = " (ambiguous)" if torques.verdict.kind == "ambiguous" else ""
            yield f"Efficiency from '{first}' to '{last}': {figure(efficiency, 6)}{word}{uncounted_words(torques)}."


# --------------------------------------------------------------------------------------------------- torque over a turn


_MINIMUM = 1e-12  # relative to all losses: smaller amounts are rounding


def cycle_sections(found: TorqueCycle) -> Iterator[Section]:
    """Yield sections on the torque during a run, its energies, and the losses of each pair, pin and bearing."""
    head = titled(found.state, "torque over a turn")
    lines = [f"Verdict: {found.verdict.kind}: {found.verdict.text}."]
    lines += [f"Not included: {each}: {each.why}." for each in found.neglected]
    if found.turns is None:
        yield Section(head, lines)
        return
    lines += [_run(found), *_remarks(found)]
    locked = [(_place(start), _place(end)) for start, end in found.locked]
    tables = [Table(("locked from turn", "to turn"), cut(locked))] if locked else []
    yield Section(head, lines, (_torques(found), *tables))
    if found.energy is not None:
        unit = "Energies in J." if found.newton_metres else "Energies in the unit of the loads times radians."
        yield Section(titled(found.state, "energy over the run"), (unit,), (_energies(found), *_parts(found)))


def turns_text(turns: float) -> str:
    """Return a string with a number of turns, such as `1 turn` or `2.5 turns`."""
    return f"{turns:g} turn{'' if turns == 1 else 's'}"


def _run(found: TorqueCycle) -> str:
    assert found.turns is not None
    positions = f"{len(found.turns)} positions, including kinks and both sides of jumps"
    text = f"Torque at '{found.link}' over {turns_text(found.span)} of the input, at {positions}"
    if found.period is not None:
        whole = found.span / found.period
        text += f"; everything repeats after {turns_text(found.period)}"
        # tolerance for a run of exactly one period
        text += "" if whole >= 1 - 1e-9 else ", and this run is a part of the period"
    return text + "."


def _remarks(found: TorqueCycle) -> Iterator[str]:
    """Yield sentences on a run: shares at which the train locks, efficiency, largest loss, recirculation and others."""
    shares = {
        "no torque balances: the train locks": found.locked_share,
        "loads and the crank both put power in, and all of it is lost": found.held_share,
        "several patterns of power flow balance; the one with the minimum loss is used": found.ambiguous_share,
    }
    yield from (f"In {percent_text(share)} of the run {what}." for what, share in shares.items() if share)
    if found.efficiency:
        yield f"Efficiency, energy out divided by energy in: {figure(found.efficiency, 10)}."
    elif found.energy is not None and found.energy.net_in > 0:
        yield "No net energy is taken out: all energy put in is lost."
    if found.loses_most is not None and len(found.parts) > 1:
        yield f"The largest loss is in {found.loses_most}."
    if changes := {name: count for name, count in found.flank_changes.items() if count}:
        words = ", ".join(f"{name} {count} times" for name, count in changes.items())
        yield f"The torque reverses and backlash is crossed: {words}."
    if found.recirculating:
        words = ", ".join(f"{figure(share, 4)} times at {name}" for name, share in found.recirculating.items())
        yield f"Transmitted power exceeds the power put in: {words}."
    if not found.complete:
        yield "Not all patterns of power flow were tried."


def _torques(found: TorqueCycle) -> Table:
    rows = [("mean", figure(found.mean, 9), "", "")]
    for name in ("maximum", "minimum", "starting"):
        extreme, cells = getattr(found, name), ("-", "", "")
        if extreme is not None:
            days = "" if extreme.days is None else figure(extreme.days, 7)
            cells = (figure(extreme.torque, 9), figure(extreme.turns, 9), days)
        rows.append((name, *cells))
    return filled_table((f"torque at {found.link}", found.unit or "torque", "at turn", "day"), rows, 3)


def _place(place: PlaceInRun) -> str:
    day = "" if place.days is None else f" (day {figure(place.days, 7)})"
    return f"{figure(place.turns, 9)}{day}"


def _energies(found: TorqueCycle) -> Table:
    energy = found.energy
    assert energy is not None
    whole = energy.put_in + energy.loads_put_in  # loads that drive put in energy too
    amounts = {
        f"put in at {found.link}": energy.put_in,
        f"given back at {found.link}": energy.returned,
        "put in by loads": energy.loads_put_in,
        "taken out by loads": energy.taken_out,
        "lost in teeth": energy.mesh,
        "lost in couplings": energy.pin,
        "lost in bearings": energy.bearing,
    }
    return energy_table("energy", amounts, whole, 9)


def energy_table(head: str, amounts: Mapping[str, float], whole: float, digits: int) -> Table:
    """Return a table of energies and their percentages of the energy input `whole`; rounding errors are omitted."""
    rows = [
        (name, figure(value, digits), _share(value, whole))
        for name, value in amounts.items()
        if abs(value) > _MINIMUM * whole
    ]
    return Table(("over the run", head, "of all put in"), rows)


def _parts(found: TorqueCycle) -> Iterator[Table]:
    """Yield a table of the lost and transmitted energy of each pair, pin and bearing, in descending order of loss."""
    assert found.energy is not None
    lost = found.energy.lost
    rows = []
    # stable, so that equal losses keep the declared order
    for name, part in sorted(found.parts.items(), key=lambda each: -each[1].loss):
        loss = part.loss if part.loss > _MINIMUM * lost else 0.0
        if loss or part.passed:
            passed = ("", "") if part.kind == "bearing" else (figure(part.passed, 7), str(part.flank_changes))
            rows.append((name, figure(loss, 7), _share(loss, lost) if loss else "", *passed))
    if rows:
        yield Table(("where", "lost", "of all lost", "transmitted", "flank changes"), cut(rows))


def _share(part: float, whole: float) -> str:
    return percent_text(part / whole) if whole else "-"
