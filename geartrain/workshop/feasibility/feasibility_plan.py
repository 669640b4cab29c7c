"""Input data of feasibility trials: cutting errors, friction, torque limit at the crank, strength of loaded parts.

Stresses are computed once for the declared loads, and then scaled by the torques of the gear pairs in each trial.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf, pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import GearTrainError
from geartrain.train.declaration import material_named
from geartrain.workshop.cutting.declared_errors import ErrorOverride
from geartrain.workshop.monte_carlo.friction_trials import draw_friction, friction_spreads
from geartrain.workshop.monte_carlo.trial_block import BLOCK, HAND, STRENGTH, RandomStreams
from geartrain.workshop.monte_carlo.trial_plan import TrialPlan, find_trial_plan

if TYPE_CHECKING:
    from geartrain.dynamics import Torques
    from geartrain.numerics.arrays import Floats
    from geartrain.train import Train

_SAMPLES = 2_000  # positions of the input in a run


def wedge_torque(torque: float, front: tuple[float, float], back: tuple[float, float]) -> float:
    """Return the torque that the flanks of a jammed pair exert on its driven wheel [unit of `torque`] by equation (7)
    of docs/cut-by-hand.md; 0 if the pair releases itself. Equal ratios without friction give an infinite torque.

    torque        torque on the driver
    front, back   ratio of driven to driver speed, and efficiency, of each flank; at the back the driven wheel drives

    >>> round(wedge_torque(1.0, (1.0, 0.95), (1.0, 0.95)), 6)
    9.74359
    """
    (ratio, efficiency), (ratio_back, efficiency_back) = front, back
    net = (ratio / efficiency if efficiency > 0 else inf) - ratio_back * efficiency_back
    return torque / net if net > 0 else 0.0 if net < 0 else inf


class PairLoads(NamedTuple):
    """Torque at the crank [N m], and the torque on the driven wheel [N m] and the efficiency [1] of each gear pair."""

    crank: float
    driven: Mapping[str, float]
    efficiency: Mapping[str, float]


@dataclass(frozen=True)
class LoadedPart:
    """Tooth of a wheel, or arbor with its pivots, which may break under load."""

    name: str
    material: str
    strength: float
    """Median of the strength [MPa]."""
    spread: float
    """Standard deviation of the natural logarithm of the strength [1]."""
    stress: float
    """Stress under the declared loads [MPa]."""
    loads: Mapping[str, float]
    """Torque on the driven wheel of each pair that loads the part, under the declared loads [N m], keyed by pair."""

    def stresses(self, torques: Mapping[str, Floats | float]) -> Floats:
        """Return the stress of the part under given torques of the pairs, keyed by pair [MPa].

        It is an upper bound if several pairs load the part.
        """
        ratios = [np.asarray(torques[name]) / own for name, own in self.loads.items() if own and name in torques]
        found: Floats = self.stress * np.max(ratios, axis=0) if ratios else np.zeros(1)
        return found


@dataclass(frozen=True)
class FeasibilityPlan:
    """Input data of feasibility trials of a train in one state. The fields are described in `find_feasibility_plan`."""

    cutting: TrialPlan
    declared: Train
    state: str | None = None
    turns: float | None = None
    per_part: bool = False

    @cached_property
    def train(self) -> GearTrain:
        """Gear train as declared, without random changes."""
        return GearTrain(self.declared)

    @cached_property
    def crank(self) -> str:
        """Name of the link whose torque is computed: the crank or, if there is none, the driving link."""
        return self.declared.crank or self.cutting.driving_link

    @cached_property
    def torques(self) -> Torques:
        """Torques under the declared loads, with nominal friction."""
        return self.train.torques(self.state)

    @cached_property
    def nominal(self) -> PairLoads | None:
        """Torques with nominal friction; None if loads with a unit are missing, or do not determine the torques."""
        known = self.declared.is_loaded(self.state) and self.declared.has_torque_units(self.state)
        return self.loads(self.train) if known else None

    def loads(self, train: GearTrain) -> PairLoads | None:
        """Return the torques of a train, or None if the loads do not determine them.

        The torque at the crank is infinite if friction locks the train.
        """
        found = train.torques(self.state)
        crank = found.external.get(self.crank)
        if found.verdict.kind in ("self-locking", "stalled"):
            return PairLoads(inf, {}, {})
        if not found.verdict or crank is None:
            return None
        sense = -1 if train.solve(self.state).speeds[self.crank] < 0 else 1
        shares = {name: float(pair.share) for name, pair in found.pairs.items()}
        driven = dict(_driven_torques(train, found))
        if self.turns is None:
            return PairLoads(sense * float(crank), driven, shares)
        run = train.torques(self.state, turns=self.turns, samples=_SAMPLES, of=self.crank)
        maxima = {name: part.maximum for name, part in run.parts.items() if name in driven}
        return PairLoads(inf if run.maximum is None else run.maximum.torque, {**driven, **maxima}, shares)

    def drawn_loads(self, seed: int, trial: int) -> PairLoads | None:
        """Return the torques with the random friction of one trial, or None if no loads are declared."""
        if self.nominal is None or not friction_spreads(self.declared):
            return self.nominal
        return self.loads(GearTrain(draw_friction(self.declared, seed, trial, self.per_part)))

    @cached_property
    def parts(self) -> tuple[LoadedPart, ...]:
        """Teeth and arbors whose stress and strength are known; empty if no loads are declared."""
        return tuple(self._parts(self.nominal.driven)) if self.nominal is not None and self.nominal.driven else ()

    def _parts(self, driven: Mapping[str, float]) -> Iterator[LoadedPart]:
        found = self.train.strength(self.state, over=self.turns)
        for pair in found.pairs.values():
            for wheel in pair.wheels:
                own = {pair.pair: driven[pair.pair]}
                yield from self._part(f"tooth of {wheel.wheel}", wheel.material, wheel.tip_stress, own)
        for arbor in found.arbors:
            link = self.declared.links[arbor.link]
            gears = (gear for gear in self.declared.gears if not {*gear.pair}.isdisjoint(link.wheels))
            own = {gear.name: driven[gear.name] for gear in gears if gear.name in driven}
            if link.arbor is not None:
                # bending stress 16 F l / (pi d^3) of a pivot of diameter d and length l; the force F is pressure d l
                diameter = 1e3 * (link.arbor.pivot or link.arbor.diameter).si
                length = diameter if link.arbor.pivot_length is None else 1e3 * link.arbor.pivot_length.si
                bending = 16 * arbor.pivot_pressure * length**2 / (pi * diameter**2)
                yield from self._part(f"arbor of {arbor.link}", arbor.material, max(arbor.stress, bending), own)

    def _part(self, name: str, material: str, stress: float, loads: Mapping[str, float]) -> Iterator[LoadedPart]:
        known = material_named(self.declared, material)
        if known.strength is not None:
            yield LoadedPart(name, material, known.strength.si / 1e6, float(known.spread.value), stress, loads)

    def strengths(self, seed: int, trials: int) -> Floats:
        """Return the lognormally distributed strength of each part in each trial [MPa], shape (trials, parts)."""
        materials, found = sorted({part.material for part in self.parts}), np.zeros((trials, len(self.parts)))
        for at, part in enumerate(self.parts):
            item = at if self.per_part else materials.index(part.material)
            found[:, at] = part.strength * np.exp(part.spread * _drawn("standard_normal", seed, trials, item, STRENGTH))
        return found

    def hands(self, seed: int, trials: int) -> Floats | None:
        """Return the maximum torque of the hand or drive at the crank in each trial [N m], or None if undeclared."""
        drive = self.declared.case(self.state).drive
        if drive is None or drive.steady_torque is None:
            return None
        if drive.hand is None or drive.hand.range is None:
            return np.full(trials, drive.steady_torque)
        low, high = (end.si for end in drive.hand.range)
        return low + (high - low) * _drawn("random", seed, trials, 0, HAND)

    def held(self, pair: str) -> Mapping[str, float]:
        """Return the torques in a train that is jammed in one pair, whose driven link does not move.

        The mapping contains the torque on the driven wheel of each pair divided by the torque at the crank [1], without
        losses, keyed by pair. It is empty if the torques are not determined.
        """
        gear = self.torques.pairs.get(pair)
        if gear is None or gear.driver not in self.declared.wheels:
            return {}
        driven = next(link for link in gear.links[:2] if link != self.declared.wheels[gear.driver][0])
        train = GearTrain(_lossless(self.declared))
        try:
            found = train.driven(driven, self.crank, self.state)
        except GearTrainError:  # the held link is the crank itself
            return {}
        torque = found.external.get(self.crank)
        if not found.verdict or not torque:
            return {}
        return {name: each / abs(float(torque)) for name, each in _driven_torques(train, found) if each}


def _drawn(law: str, seed: int, trials: int, item: int, kind: int) -> Floats:
    """Return one random number for each trial, shape (trials,).

    law          name of the method of `numpy.random.Generator` that draws the numbers, such as "random"
    item, kind   number of the part and of the random quantity, which select an independent generator
    """
    # whole blocks, so that the numbers do not depend on the number of trials
    blocks = (RandomStreams(seed, block).rng(item, kind) for block in range(-(-trials // BLOCK)))
    found: Floats = np.concatenate([getattr(rng, law)(BLOCK) for rng in blocks])[:trials]
    return found


def _driven_torques(train: GearTrain, found: Torques) -> Iterator[tuple[str, float]]:
    """Yield the name of each gear pair that transmits torque, and the torque on its driven wheel [N m]."""
    wheels = train.mechanics.unfolded.declaration.wheels
    for name, pair in found.pairs.items():
        if pair.driver in wheels:
            yield name, abs(float(pair.torques[1 - pair.links.index(wheels[pair.driver][0])]))


def _lossless(declared: Train) -> Train:
    """Return the train without friction, and with all efficiencies equal to 1."""

    def without(part: object, *keys: str) -> object:
        return part.model_copy(update={key: None for key in keys if key in type(part).model_fields})  # type: ignore[attr-defined]

    lossy = ("gears", "couplings")
    parts = {name: [without(each, "friction", "efficiency") for each in getattr(declared, name)] for name in lossy}
    links = {name: without(link, "bearing") for name, link in declared.links.items()}
    return declared.model_copy(update={"friction": None, **parts, "links": links})


def find_feasibility_plan(
    train: GearTrain,
    settings: Sequence[ErrorOverride] = (),
    outputs: Sequence[str] = (),
    state: str | None = None,
    without: Sequence[str] = (),
    turns: float | None = None,
    per_part: bool = False,
) -> FeasibilityPlan:
    """Collect the input data of feasibility trials of a train in one state.

    Parameters
    ----------
    train : GearTrain
        Train with a tooth form for which cutting errors are computed. Loads with units, friction, materials with a
        strength, and a drive with a torque are used if they are declared.
    settings, outputs, state, without
        As in `find_trial_plan`; cutting errors are optional.
    turns : float, optional
        Revolutions of the input whose maximum torque is used, instead of the torque at mean speeds.
    per_part : bool
        True to draw friction and strength for each part; by default they are drawn once per workshop. Separate draws
        average out, and make the interval of the crank torque about half as wide.

    Returns
    -------
    FeasibilityPlan
        Input of `run_feasibility`.

    Raises
    ------
    QuestionError
        If the train has no pair for which cutting errors are computed.

    Examples
    --------
    >>> from geartrain import load
    >>> plan = find_feasibility_plan(load("moon-triangular"))
    >>> plan.crank, plan.nominal
    ('crank', None)
    """
    cutting = find_trial_plan(train, settings, outputs, state, without, perfect=True)
    return FeasibilityPlan(cutting, train.declaration, state, turns, per_part)
