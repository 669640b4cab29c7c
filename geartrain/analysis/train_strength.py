"""The fifth part of a train that answers: what torques do to teeth and arbors, and what turning wears off."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING

from geartrain.analysis.train_in_time import TrainInTime
from geartrain.analysis.train_kinematics import of_all_planets
from geartrain.errors import Problem, QuestionError, check_numbers

if TYPE_CHECKING:
    from geartrain.dynamics import TrainStrength

_YEAR = 365.25 * 86400  # s


class TrainUnderLoad(TrainInTime):
    """What `GearTrain` knows of strength."""

    @of_all_planets
    def strength(
        self,
        state: str | None = None,
        *,
        turns: float | None = None,
        years: float | None = None,
        wear: tuple[float, float] | None = None,
        over: float | None = None,
    ) -> TrainStrength:
        """Pressures, root stresses, safety factors and wear under the loads of one state (docs/strength.md).

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        turns : float, optional
            Turns of the input over which wear is counted, above 0.
        years : float, optional
            The same by years of 365.25 days, where the unit of speeds or a `rate` says how fast the train runs.
        wear : tuple of float, optional
            Least and greatest wear coefficient K of Archard's law; by default 1e-7 to 1e-3.
        over : float, optional
            Turns of the input: stresses are those of the greatest torque of each pair in them, with the ratios and the
            friction that teeth and pins have at every position; by default those of its mean torque.

        Returns
        -------
        TrainStrength
            With a verdict: where torques do not follow from the loads there is nothing else.

        Raises
        ------
        QuestionError
            If loads have no unit, time is given twice or cannot be told, or K is no range.
        """
        from geartrain.dynamics.strength.strength_results import TrainStrength, WearRange
        from geartrain.dynamics.strength.train_strength import StrengthQuestion
        from geartrain.dynamics.torques.power_flow import has_torque_units
        from geartrain.teeth.strength.archard_wear import WEAR_RANGE

        check_numbers(turns=turns, years=years, over=over)
        own = WearRange(*(wear or WEAR_RANGE))
        if not 0 < own.least <= own.greatest < inf:
            what = f"{own.least:g} to {own.greatest:g} is no range of wear coefficients"
            raise QuestionError(Problem(what, "K is above 0, the lesser first", "give for example 1e-7 1e-3"))
        found, setting = self.torques(state), self._setting(self._case(state).state)
        if not found.verdict or setting is None:
            return TrainStrength(found.state, found.verdict)
        if not has_torque_units(self.declaration, found.state):
            what = "stresses need torques with a unit"
            raise QuestionError(Problem(what, "the loads are plain numbers", "write for example `-0.5 N m`"))
        scale = self._time_of_wear(found.state, turns, years)
        covered = None if scale is None else scale * self._input_speed(found.state)
        meshes = self.meshes_in(found.state)
        question = StrengthQuestion(self, setting, found, meshes, scale, covered, own)
        if over is None:
            return question.answer()
        cycle = self.torques(state, turns=over)
        if not cycle.parts:
            return TrainStrength(found.state, cycle.verdict)
        greatest = {name: part.greatest for name, part in cycle.parts.items()}
        return replace(question, over=over, greatest=greatest).answer()

    def tells_strength(self, state: str | None = None) -> bool:
        """True where a state has loads in units, and some wheel says what it is made of.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        """
        declared = self.declaration
        if declared.material is None and all(wheel.material is None for _, wheel in declared.wheels.values()):
            return False
        from geartrain.dynamics.torques.power_flow import has_torque_units

        return has_torque_units(declared, state)

    def _input_speed(self, state: str | None) -> float:
        """Speed of the input that is counted: the crank's, else that of the first that turns."""
        case = self._case(state)
        speeds = self._speeds.solution(case).speeds
        crank = self.declaration.crank
        if crank is not None and speeds.get(crank):
            return abs(float(speeds[crank]))
        return next((abs(float(speed)) for speed in case.inputs.values() if speed), 0.0)

    def _time_of_wear(self, state: str | None, turns: float | None, years: float | None) -> float | None:
        """Turns, in all the time, of a link whose speed is 1; None where no time is given."""
        if turns is None and years is None:
            return None
        if turns is not None and years is not None:
            raise QuestionError(Problem("a time is given twice", "by turns and by years", "leave one of them out"))
        for name, value in (("turns", turns), ("years", years)):
            if value is not None and not 0 < value < inf:
                raise QuestionError(Problem(f"{value:g} {name} wear nothing", "", "give a number above 0"))
        speed = self._input_speed(state)
        if not speed:
            raise QuestionError(Problem(f"'{self.name}' does not move", "no input turns", "drive it from an input"))
        if turns is not None:
            return turns / speed
        case, unit = self._case(state), self.declaration.unit_speed
        assert years is not None
        if case.rate is not None and case.rate.unit is not None:
            return years * _YEAR * float(case.rate.base) / speed
        if unit is None:
            what, why = "years tell no number of turns here", "speeds are plain numbers"
            raise QuestionError(Problem(what, why, "give --turns, or declare `unit` or `rate`"))
        return years * _YEAR * float(unit)
