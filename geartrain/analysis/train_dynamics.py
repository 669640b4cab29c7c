"""The third part of a train that answers: torques, and what inertia does."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, overload

from geartrain.analysis.train_kinematics import of_all_planets, of_planets_as_one
from geartrain.analysis.train_motion import TrainMotion
from geartrain.errors import check_choice, check_numbers, check_whole_numbers

if TYPE_CHECKING:
    from fractions import Fraction

    from geartrain.dynamics import DrivenWay, PowerFlow, SeparationRates, ToothImpact, TorqueCycle, Torques
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.turn.friction_study import FrictionStudy


class TrainDynamics(TrainMotion):
    """What `GearTrain` knows of torques and dynamics."""

    @overload
    def torques(self, state: str | None = None) -> Torques: ...

    @overload
    def torques(
        self,
        state: str | None = None,
        *,
        turns: float,
        samples: int = ...,
        of: str | None = None,
        on_done: Callable[[int], object] | None = None,
    ) -> TorqueCycle: ...

    @of_all_planets
    def torques(
        self,
        state: str | None = None,
        *,
        turns: float | None = None,
        samples: int = 20_000,
        of: str | None = None,
        on_done: Callable[[int], object] | None = None,
    ) -> Torques | TorqueCycle:
        """Torques on links and pairs, and the flow of power, under the loads of one state: means, or over a turn.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        turns : float, optional
            Turns of the input, above 0: the torque at every position of so many turns, with the ratio and the friction
            that real teeth, pins and bearings have there. Without it exact torques at mean speeds.
        samples : int
            Positions of such a run, 2 or more; corners and jumps come on top.
        of : str, optional
            The link whose torque is asked for over a turn, by default the crank or input.
        on_done : callable, optional
            Called with the number of positions that have been worked out since.

        Returns
        -------
        Torques or TorqueCycle
            With a verdict: self-locking, or loads that do not balance, are no error.

        Raises
        ------
        QuestionError
            If the train does not move, or turns or link are none to be asked for.
        """
        check_numbers(turns=turns)
        check_whole_numbers(samples=samples)
        setting = self._setting(state)
        if turns is not None:
            return self._torque_cycle(state, setting, turns, samples, of, on_done)
        from geartrain.dynamics.torques.torque_analysis import find_torques, torques_unknown

        return torques_unknown(state) if setting is None else find_torques(setting)

    def _torque_cycle(
        self,
        state: str | None,
        setting: LoadCase | None,
        turns: float,
        samples: int,
        of: str | None,
        on_done: Callable[[int], object] | None,
    ) -> TorqueCycle:
        from geartrain.dynamics import TorqueCycle, TorqueVerdict
        from geartrain.dynamics.turn.turn_analysis import find_torque_cycle

        links = tuple(self.declaration.links)
        if of is not None:
            check_choice("link", of, links)
        if setting is None:
            return TorqueCycle(state, TorqueVerdict("still", "the speeds of this state are not determined"), of or "")
        return find_torque_cycle(setting, self._moving(self._case(state), ()), turns, samples, of, on_done)

    @of_all_planets
    def friction_study(
        self, turns: float, samples: int = 20_000, state: str | None = None, of: str | None = None
    ) -> FrictionStudy | None:
        """A run that can be told with other coefficients of friction, in a part of the time of a new train.

        Parameters
        ----------
        turns, samples, state, of
            As of `torques`.

        Returns
        -------
        FrictionStudy or None
            None where friction is counted by its mean, or goes by a law of speed: then each needs a train of its own.
        """
        from geartrain.dynamics.turn.friction_study import find_friction_study

        setting = self._setting(state)
        if setting is None:
            return None
        return find_friction_study(setting, self._moving(self._case(state), ()), turns, samples, of)

    @of_all_planets
    def torque_period(self, state: str | None = None, of: str | None = None) -> Fraction | None:
        """Turns of the input after which the torque over a turn repeats, exactly.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        of : str, optional
            The link whose torque is asked for, by default the crank or input.

        Returns
        -------
        Fraction or None
            None where no pair that carries torque is uneven, so that the torque is one at all positions, or where
            torques are not known.

        Examples
        --------
        A clock of even teeth, whose friction goes with the place of the tooth: all repeats after a quarter of an hour.

        >>> import geartrain
        >>> geartrain.load('''
        ... extends: longcase-clock-cycloidal
        ... friction: 0.2
        ... loads: {escape: -1 N mm}
        ... ''').torque_period()
        Fraction(1, 4)
        """
        from geartrain.dynamics.torques.torque_results import TorqueVerdict
        from geartrain.dynamics.turn.turn_analysis import find_turn_balance

        setting = self._setting(state)
        if setting is None:
            return None
        found = find_turn_balance(setting, self._moving(self._case(state), ()), of)
        return None if isinstance(found, TorqueVerdict) else found.motion.period

    @of_all_planets
    def driven(self, load: str, source: str, state: str | None = None) -> Torques:
        """Torques while a unit of power leaves at one link, driven from another: efficiency, or self-locking.

        Parameters
        ----------
        load, source : str
            Two links: where the power leaves, and where it enters.
        state : str, optional
            A declared state; None only of a train that has none.
        """
        from geartrain.dynamics.torques.torque_analysis import drive, torques_unknown

        for link in (load, source):
            check_choice("link", link, tuple(self.declaration.links))
        setting = self._setting(state)
        return torques_unknown(state) if setting is None else drive(setting, load, source)

    @of_all_planets
    def drive_both_ways(self, state: str | None = None) -> list[DrivenWay]:
        """The train driven from its input, and from its output, a unit of power leaving at the other.

        Parameters
        ----------
        state : str, optional
            A declared state, by default the first.

        Returns
        -------
        list of DrivenWay
            Two ways; empty where it is not plain which link is the output.
        """
        from geartrain.dynamics import DrivenWay
        from geartrain.dynamics.torques.load_case import input_and_output

        case = self.declaration.case(self.state_or_first(state))
        found = input_and_output(self.declaration, case)
        ways = [] if found is None else [found, found[::-1]]
        return [DrivenWay(self.driven(load, source, state), source, load) for source, load in ways]

    def power_flow(self, found: Torques) -> PowerFlow:
        """The streams of power under some torques of this train.

        Parameters
        ----------
        found : Torques
            As `torques`, `driven` or `drive_both_ways` give them.
        """
        from geartrain.dynamics.torques.power_flow import find_power_flow

        return find_power_flow(found)

    @of_planets_as_one
    def impacts(self, state: str | None = None) -> Mapping[str, ToothImpact]:
        """What collisions of triangular teeth cost, by pair; empty unless inertias and a rate are declared.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.

        Returns
        -------
        mapping of str to ToothImpact
            By pair (docs/motion.md, equation 7).
        """
        case = self._case(state)
        if case.rate is None or case.rate.unit is None or not self._meshes or not self.is_heavy:
            return {}
        inertias = {each.link: each.value for each in self.inertias(state)}
        from geartrain.dynamics import Motion
        from geartrain.dynamics.motion.pair_impacts import find_impacts

        moving = self._moving(case, ())
        if moving.contradictions():
            return {}
        every = {link: (link, moving.frame) for link in self.declaration.links}
        return find_impacts(Motion(moving, every), inertias, case.rate.si)

    @of_planets_as_one
    def separation_rates(
        self, state: str | None = None, without: Sequence[str] = (), turns: float | None = None
    ) -> SeparationRates:
        """At what rates of the input flanks first part, by pair: above the least `motion` does not hold.

        Counted are inertia, loads, a weight or a torque that drives, friction of bearings and of teeth that do not keep
        their ratio, viscous drag, and where speeds jump their blows (docs/dynamics.md, section 3).

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        without : sequence of str
            Pairs left out, as of `motion`.
        turns : float, optional
            Turns of the input that are searched [turn]; by default all after which everything repeats, or fewer where
            these are very many.

        Returns
        -------
        SeparationRates
            With the pair that parts first.

        Raises
        ------
        QuestionError
            If the train does not move, no inertia is declared, or a torque has no unit.

        Examples
        --------
        A slot whose axis is 8 mm from that of a pin at 10 mm, with 100 g cm^2 and a drag of 1 N mm behind it:

        >>> import geartrain
        >>> train = geartrain.load('''
        ... links: {frame: {}, a: {}, b: {inertia: 100 g cm2, bearing: 1 N mm}}
        ... revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
        ... couplings: [{kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm}]
        ... inputs: {a: 1}
        ... ''')
        >>> found = train.separation_rates()
        >>> found.pair, round(found.rate, 6)
        ('a~b', 0.440669)
        """
        from geartrain.dynamics.contacts.rubbing_arms import separate_rubbing
        from geartrain.dynamics.inertia.inertial_contacts import InertialContacts
        from geartrain.dynamics.inertia.inertial_loads import find_inertial_loads
        from geartrain.dynamics.inertia.separation_rate import find_separation_rates

        check_numbers(turns=turns)
        case = self._case(state)
        inertias = self.inertias(state)
        moving = self._moving(case, without)
        acting = find_inertial_loads(self.declaration, case, self.tree, inertias, moving.speeds)
        rubbing, uncounted = separate_rubbing(moving, self.declaration.gears)
        contacts = InertialContacts(moving, acting, rubbing=rubbing)
        return replace(find_separation_rates(contacts, inertias, state, turns), uncounted=uncounted)

    def tells_separation(self, state: str | None = None) -> bool:
        """True if `separation_rates` has an answer: a link behind the input has an inertia, and torques have units.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        """
        from geartrain.dynamics.inertia.inertial_loads import torques_have_units

        if not self.is_heavy or not torques_have_units(self.declaration, self._case(state)):
            return False
        return any(each.value for each in self.inertias(state))
