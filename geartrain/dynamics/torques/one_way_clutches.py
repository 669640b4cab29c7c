"""Behaviour of the one-way clutches (freewheels, overrunning clutches, ratchets) of a train in one state.

A clutch between links a and b permits relative rotation in the sense s = 1 (forward) or -1 (backward):
s (w_b - w_a) >= 0, s T >= 0 and T (w_b - w_a) = 0, with speeds w and the torque T on b. The patterns of holding
clutches are enumerated with exact speeds and with torques that include declared losses. If no loads are declared, each
output in turn is assumed to resist its rotation.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import combinations

from geartrain.dynamics.torques.drivers import drag_torques
from geartrain.dynamics.torques.load_case import PRESCRIBED, LoadCase, power_inputs
from geartrain.dynamics.torques.torque_analysis import find_torques, resist
from geartrain.dynamics.torques.torque_results import Torques, TorqueVerdict
from geartrain.dynamics.train_mechanics import TrainMechanics
from geartrain.errors import DeclarationError, Problem
from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.circuits.joint_tree import close_joints, rigid_across_axes
from geartrain.kinematics.train_kinematics import TrainKinematics
from geartrain.numerics.elimination import LinearForm, add_into, eliminate, feasible
from geartrain.train import StateCase, Train
from geartrain.train.states import Clutch, OneWayAction, SteppedLink

MOST_CLUTCHES = 12
"""Maximum number of one-way clutches in one state, for which 2^12 patterns are enumerated."""

_REJECTED = ("unbalanced", "overrunning")


@dataclass(frozen=True)
class ClutchPattern:
    """Set of holding clutches with its prescribed speeds, load case, and slip speeds of the overrunning clutches."""

    holding: tuple[str, ...]
    case: StateCase
    setting: LoadCase | None
    """Load case of the pattern; None if the speeds contradict each other."""
    slips: Mapping[str, Fraction | None]
    """Slip speed of each clutch that does not hold [the train's unit of speed], by clutch; None if it is undetermined.
    """

    moves: bool
    """True if all clutches that do not hold can overrun for some values of the undetermined speeds."""

    @property
    def stopped(self) -> tuple[str, ...]:
        """Clutches that are assumed to overrun, but whose slip speed in this pattern is 0 or has the wrong sense."""
        return tuple(name for name, slip in self.slips.items() if slip is not None and slip <= 0)


def decide_case(train: Train, state: str | None) -> StateCase:
    """Return the prescribed speeds, loads and engaged clutches of a state, including the one-way clutches that hold,
    and whether each one-way clutch holds or overruns.

    The case has `problems` if the declaration does not determine which clutches hold, if the links of a clutch are on
    different axes, or if there are more than `MOST_CLUTCHES` clutches.
    """
    try:
        return _Decision(TrainMechanics(TrainKinematics(train)), state, train.one_way_clutches(state)).case()
    except DeclarationError as error:
        return replace(train.case(state, ()), problems=tuple(error.problems))


@dataclass(frozen=True)
class _Decision:
    train: TrainMechanics
    state: str | None
    names: tuple[str, ...]

    def case(self) -> StateCase:
        self._refuse()
        if self._swinging:
            return self._steps(self._patterns[()])
        if not self._moving:
            return self._answer(self._contradictory(), {}, ())
        chosen = list(dict.fromkeys(each.holding for ways in self._fitting.values() for each in ways))
        if len(chosen) > 1:
            return self._undecided(chosen)
        if not chosen:
            pattern, released = self._released()
            return self._answer(pattern, {}, (f"{_joined(released, 'let')} go under this load",) if released else ())
        pattern = next(each for each in self._moving if each.holding == chosen[0])
        deciding = {load: self._torques(pattern, load) for load, ways in self._fitting.items() if ways}
        return self._answer(pattern, deciding, tuple(self._reversed(pattern, deciding)))

    # -------------------------------------------------------------------------------------------------------- patterns

    @cached_property
    def _patterns(self) -> Mapping[tuple[str, ...], ClutchPattern]:
        found: dict[tuple[str, ...], ClutchPattern] = {}
        for some in (each for size in range(len(self.names) + 1) for each in combinations(self.names, size)):
            fewer = (found.get(some[:at] + some[at + 1 :]) for at in range(len(some)))
            # contradictory speeds remain contradictory if more clutches hold
            if all(each is not None and each.setting is not None for each in fewer):
                found[some] = self._pattern(some)
        return found

    def _pattern(self, holding: tuple[str, ...]) -> ClutchPattern:
        own = self.train
        (case,) = close_joints(own.declaration, own.tree, [own.declaration.case(self.state, holding)])
        setting = own.make_load_case(case)
        others = [name for name in self.names if name not in holding]
        if setting is None:
            return ClutchPattern(holding, case, None, dict.fromkeys(others), False)
        speeds = setting.forms or {link: {PRESCRIBED: speed} for link, speed in setting.speeds.items()}
        forms = {name: self._slip_form(setting, name, speeds) for name in others}
        slips = {
            name: None if any(at != PRESCRIBED for at in form) else form.get(PRESCRIBED, Fraction(0))
            for name, form in forms.items()
        }
        moves = all(slip is None or slip > 0 for slip in slips.values())
        if moves and setting.forms:
            # the constants are multiplied by a further unknown t >= 1, so that slips above 0 can be scaled beyond 1
            scale = len(setting.forms)
            rows: list[LinearForm] = [{scale: Fraction(1), PRESCRIBED: Fraction(-1)}]
            for form in forms.values():
                unknowns = {at: value for at, value in form.items() if at != PRESCRIBED}
                rows.append({**unknowns, scale: form.get(PRESCRIBED, Fraction(0)), PRESCRIBED: Fraction(-1)})
            moves = feasible(rows)
        return ClutchPattern(holding, case, setting, slips, moves)

    def _clutch(self, name: str) -> tuple[Clutch, str, str, int]:
        """Return a one-way clutch, its two links (for a brake: the frame and the braked link), and the sense in which
        it overruns, 1 or -1.
        """
        clutch = self.train.declaration.clutches[name]
        first, second = clutch.locks or (self.train.declaration.frame, clutch.fixes or "")
        (sense,) = clutch.senses
        return clutch, first, second, sense

    def _slip_form(self, setting: LoadCase, name: str, speeds: Mapping[str, LinearForm]) -> LinearForm:
        """Return the slip speed of a clutch as a linear form in the undetermined speeds."""
        _, first, second, sense = self._clutch(name)
        form: LinearForm = {}
        add_into(form, speeds[second], sense)
        add_into(form, speeds[first], -sense * setting.sense(first) * setting.sense(second))
        return form

    @cached_property
    def _moving(self) -> Sequence[ClutchPattern]:
        """Sets of holding clutches for which no other clutch slips in the sense in which it must hold."""
        return [each for each in self._patterns.values() if each.moves]

    def _contradictory(self) -> ClutchPattern:
        """Return a set of holding clutches whose speeds are contradictory, if possible the clutches that would
        otherwise slip in the wrong sense.
        """
        pattern = self._patterns[()]
        while pattern.setting is not None and pattern.stopped:
            held = {*pattern.holding, *pattern.stopped}
            pattern = self._pattern(tuple(name for name in self.names if name in held))
        others = (each for each in self._patterns.values() if each.setting is None)
        return pattern if pattern.setting is None else next(others, pattern)

    # ----------------------------------------------------------------------------------------------------------- loads

    @cached_property
    def _loads(self) -> Mapping[str, tuple[str, str] | None]:
        """Loads under which the clutches are decided, by name. Each value is the loaded link and its reference link, or
        None for all declared loads together.
        """
        declared, case = self.train.declaration, self._patterns[()].case
        if case.loads:
            return {" and ".join(case.loads): None}
        ends = {name: output.links(name, declared.frame) for name, output in case.outputs.items()}
        outputs = {name: each for name, each in ends.items() if each[0] not in case.inputs}
        top = self.train.tree.top
        borne = [link for link in declared.links if top.get(link) == declared.frame and link not in case.inputs]
        return outputs or {link: (link, declared.frame) for link in borne}

    def _torques(self, pattern: ClutchPattern, load: str, way: int = 1) -> Torques | None:
        """Return the torques under one load, multiplied by `way` (1 or -1); None if the loaded link is at rest."""
        setting, links = pattern.setting, self._loads[load]
        assert setting is not None
        if links is None:
            loads = {link: replace(torque, value=way * torque.value) for link, torque in pattern.case.loads.items()}
            return find_torques(replace(setting, case=replace(setting.case, loads=loads)), flows_only=True)
        if setting.relative(*links) is None:
            return Torques(self.state, TorqueVerdict("unbalanced", f"the speed of '{load}' is not determined"))
        drag = {link: way * torque for link, torque in drag_torques(setting, *links).items()}
        return resist(setting, drag) if drag else None

    def _fits(self, pattern: ClutchPattern, load: str, way: int = 1) -> bool:
        if pattern.setting is not None and not pattern.holding and not pattern.setting.forms:
            return True  # nothing holds, and every speed is determined
        found = self._torques(pattern, load, way)
        return found is None or found.verdict.kind not in _REJECTED

    @cached_property
    def _fitting(self) -> Mapping[str, Sequence[ClutchPattern]]:
        """Sets of holding clutches that agree with the speeds and with the torques of one load, by name of the load."""
        return {load: [each for each in self._moving if self._fits(each, load)] for load in self._loads}

    def _released(self) -> tuple[ClutchPattern, tuple[str, ...]]:
        """Return the set of holding clutches that violates the fewest conditions, without the clutches in it that
        cannot hold, and the names of these clutches.
        """
        found = []
        for pattern in self._moving:
            kinds = [each.verdict for load in self._loads if (each := self._torques(pattern, load)) is not None]
            wrong = {name for each in kinds if each.kind == "overrunning" for name in each.candidates}
            missing = sum(each.kind == "unbalanced" for each in kinds)
            released = self._members(pattern, wrong)
            # ties: a pattern that names the released clutches, then the one with the fewest holding clutches
            found.append((len(wrong) + missing, not released, len(pattern.holding), pattern.holding, released))
        *_, holding, released = min(found)
        return self._patterns[tuple(name for name in holding if name not in released)], released

    def _members(self, pattern: ClutchPattern, named: set[str]) -> tuple[str, ...]:
        """Return the holding clutches of a pattern that occur in `named`, in which clutches between the same links have
        one common name, such as "A and B".
        """
        joined = {pattern.case.clutches[links] for links in pattern.case.senses} & named
        return tuple(name for name in pattern.holding if pattern.case.clutches[self._clutch(name)[0].links] in joined)

    def _reversed(self, pattern: ClutchPattern, deciding: Mapping[str, Torques | None]) -> Iterator[str]:
        """Yield a note for each load that would release a clutch if power entered at the load."""
        for load, forward in deciding.items():
            if forward is None or not pattern.holding:
                continue
            backward = self._torques(pattern, load, -1)
            if backward is None or backward.verdict.kind != "overrunning":
                continue
            released = self._members(pattern, set(backward.verdict.candidates))
            others = [each for each in self._moving if self._fits(each, load, -1)]
            taking = [name for each in others[:1] for name in each.holding if name not in pattern.holding]
            then = _joined(taking, "hold") if taking else "no engine braking"
            yield f"driven from {load}, {_joined(released, 'let')} go: {then}"

    # ---------------------------------------------------------------------------------------------------------- answer

    def _answer(
        self, pattern: ClutchPattern, deciding: Mapping[str, Torques | None], notes: tuple[str, ...]
    ) -> StateCase:
        required = () if self.state is None else self.train.declaration.states[self.state].engaged
        actions = []
        # if the speeds contradict each other, only the clutches that hold have a meaning
        for name in self.names if pattern.setting is not None else pattern.holding:
            holds = name in pattern.holding
            torque, unit = self._torque(pattern, name, deciding) if holds else (Fraction(0), "")
            slip = Fraction(0) if holds else pattern.slips.get(name)
            teeth = self._clutch(name)[0].teeth
            actions.append(OneWayAction(name, holds, slip, torque, unit, name in required, teeth))
        relieved = {each.name for each in actions if each.holds and each.torque == 0}
        return replace(pattern.case, one_way=tuple(actions), notes=(*notes, *self._shared(pattern, relieved)))

    def _torque(
        self, pattern: ClutchPattern, name: str, deciding: Mapping[str, Torques | None]
    ) -> tuple[Fraction | None, str]:
        """Return the torque of a clutch on its second link, which is None if it depends on the load, and its unit."""
        clutch, _, _, sense = self._clutch(name)
        links, found, unit = clutch.links, set[Fraction | None](), ""
        source = power_inputs(pattern.setting)[:1] if pattern.setting is not None else ()
        for load, torques in deciding.items():
            held = next((each for each in torques.held if each.links == links), None) if torques else None
            if torques is None or held is None or held.torques is None:
                return None, ""
            # a brake or lock on the same links transmits what the clutch cannot transmit
            if links not in pattern.case.senses and sense * held.torques[-1] < 0:
                return Fraction(0), ""
            if held.clutch != name:
                return None, ""
            if self._loads[load] is None:
                return held.torques[-1], "N m" if self.train.declaration.has_torque_units(self.state) else ""
            given = torques.external.get(source[0]) if len(torques.requested) == 1 and source else None
            found.add(held.torques[-1] / given if given else None)
            unit = f"times the torque of {source[0]}" if source else ""
        return (found.pop(), unit) if len(found) == 1 and None not in found else (None, "")

    def _shared(self, pattern: ClutchPattern, relieved: Collection[str]) -> Iterator[str]:
        """Yield notes on clutches that share an undetermined torque, and on slip speeds that vary in a revolution."""
        case = pattern.case
        for links in dict.fromkeys(self._clutch(name)[0].links for name in pattern.holding):
            clutches = self.train.declaration.clutches
            names = [name for name in case.engaged if clutches[name].links == links and name not in relieved]
            if len(names) > 1:
                yield f"{_joined(names)} {'all' if names[2:] else 'both'} hold; how they share the torque is not known"
        for name, couplings in self._varying.items() if not self._swinging else ():
            ids = _joined([each.id for each in couplings])
            yield f"{name} is decided by mean speeds, but {ids} varies within a turn"
        groups: dict[tuple[str, str], dict[int, str]] = {}
        for name in self.names:
            _, first, second, sense = self._clutch(name)
            ends, sense = ((first, second), sense) if first <= second else ((second, first), -sense)
            groups.setdefault(ends, {}).setdefault(sense, name)
        for name, *others in (tuple(each.values()) for each in groups.values()):
            if others:
                clutch = self._clutch(name)[0]
                held = f"'{clutch.links[-1]}'"
                fix = f"{{fixes: {clutch.fixes}}}" if clutch.fixes else f"{{locks: [{', '.join(clutch.links)}]}}"
                yield f"{name} and {others[0]} together hold {held}: write a brake or a clutch, such as {name}: {fix}"

    # -------------------------------------------------------------------------------------------------------- refusals

    def _refused(self, what: str, why: str, fix: str) -> StateCase:
        place = self.train.declaration.place(*(("clutches",) if self.state is None else ("states", self.state)))
        case = self._patterns[()].case
        return replace(case, problems=(*case.problems, Problem(what, why, fix, place)))

    def _undecided(self, chosen: Sequence[tuple[str, ...]]) -> StateCase:
        """Return the prescriptions of the state with the problem that the loads decide which clutches hold."""
        common = set(chosen[0]).intersection(*chosen[1:])
        open_ = [name for name in self.names if any(name in each for each in chosen) and name not in common]
        ways = {
            load: " or ".join(_joined(each.holding, "hold") or "none holds" for each in found)
            for load, found in self._fitting.items()
            if found
        }
        why = "; ".join(f"with a load on {load}: {way}" for load, way in ways.items())
        some = "{" + ", ".join(f"{load}: -1" for load in list(ways)[:1]) + "}"
        what = f"whether {_joined(open_, 'hold')} depends on the loads"
        return self._refused(what, why, f"declare `loads`, such as `loads: {some}`")

    @cached_property
    def _varying(self) -> Mapping[str, Sequence[Circuit]]:
        """Couplings of variable ratio on which the slip speed of each one-way clutch depends, by name of the clutch."""
        setting = self._patterns[()].setting
        varying = [each for each in setting.circuits if each.swings] if setting is not None else []
        if setting is None or not varying:
            return {}
        symbols = {each.id: -1 - at for at, each in enumerate(varying)}
        index = {link: at for at, link in enumerate(setting.train.links)}
        rows: list[LinearForm] = []
        for row in setting.system.equations:
            form = {index[link]: Fraction(factor) for link, factor in row.terms}
            rows.append(form | ({symbols[row.label]: Fraction(1)} if row.label in symbols else {}))
        solved = eliminate(rows).forms()
        forms = {link: solved.get(at, {at: Fraction(1)}) for link, at in index.items()}
        slips = {name: self._slip_form(setting, name, forms) for name in self.names}
        found = {name: [each for each in varying if symbols[each.id] in slip] for name, slip in slips.items()}
        return {name: each for name, each in found.items() if each}

    @cached_property
    def _swinging(self) -> Sequence[str]:
        """Names of the clutches that an oscillating link drives."""
        return [name for name, couplings in self._varying.items() if not all(each.ratio for each in couplings)]

    def _steps(self, pattern: ClutchPattern) -> StateCase:
        """Return the prescriptions in a state in which oscillating links drive one link in steps. If its mean advance
        cannot be computed, `problems` of the returned case contains the reason.
        """
        setting, frame, names = pattern.setting, self.train.declaration.frame, _joined(self._swinging)
        assert setting is not None
        driven, drivers, senses = set[str](), dict[str, int](), set[int]()
        for _, first, second, sense in map(self._clutch, self.names):
            opposite = setting.sense(first) * setting.sense(second)
            driven.add(_joined([link for link in (first, second) if link in setting.open]))
            # the first link drives the second in the sense of the clutch, and the second drives the first against it
            driver, way = (first, sense * opposite) if second in driven else (second, -sense)
            drivers |= {driver: way} if driver != frame else {}
            senses.add(sense if second in driven else -sense * opposite)
        (link, *others), freedoms = sorted(driven), {column for form in setting.forms.values() for column in form}
        obstacles = {
            "loads are declared, but only friction may hold the driven link": bool(setting.case.loads),
            "there are several inputs": len(setting.case.inputs) > 1,
            "not every clutch is between a common and a determined link": bool(others) or link not in setting.open,
            "the clutches drive their link in both senses": len(senses) > 1,
            f"further links are undetermined ({_joined(setting.open)})": len(freedoms - {PRESCRIBED}) > 1,
            f"'{link}' does not turn on the frame": setting.bearer(link) != frame,
        }
        if obstacle := next((text for text, applies in obstacles.items() if applies), ""):
            why = f"the driver of {names} oscillates, and {obstacle}"
            fix = f"let clutches drive one unloaded link, or write `free: [{', '.join(self._swinging)}]` in a state"
            return self._refused(f"the advance of the link behind {names} cannot be computed", why, fix)
        answer = self._answer(pattern, {}, (f"the speed of '{link}' is not determined by ratios: `motion` counts it",))
        # an undetermined speed is what the declaration means, unless it names another verdict
        expect = "free" if answer.expect == "determined" else answer.expect
        return replace(answer, stepped=SteppedLink(link, senses.pop(), drivers), expect=expect)

    def _refuse(self) -> None:
        declared, frame = self.train.declaration, self.train.declaration.frame
        if len(self.names) > MOST_CLUTCHES:
            what = f"{len(self.names)} one-way clutches are active"
            why = f"at most {MOST_CLUTCHES} are supported, because all combinations of holding clutches are tried"
            raise DeclarationError(
                [Problem(what, why, "disable some of them: list them under `free`", declared.place("clutches"))]
            )
        base = replace(declared.case(self.state, ()), inputs={}, fixed=(), locks=())
        for name in self.names:
            clutch, first, second, _ = self._clutch(name)
            alone = replace(base, fixed=clutch.links) if clutch.fixes else replace(base, locks=((first, second),))
            if first == second or any(rigid_across_axes(declared, self.train.tree, alone)):
                what = f"the one-way clutch '{name}' is not between two coaxial links"
                why = f"'{first if first != second else frame}' and '{second}' do not turn about one common axis"
                fix = "name two coaxial links, or fix a link that turns on the frame"
                raise DeclarationError([Problem(what, why, fix, declared.place("clutches", name))])


def _joined(names: Sequence[str], verb: str = "") -> str:
    """Return names joined by commas and "and", followed by the verb in the required number; "" without names."""
    text = " and ".join(filter(None, (", ".join(names[:-1]), *names[-1:])))
    return f"{text} {verb}{'s' if len(names) == 1 else ''}" if verb and names else text
