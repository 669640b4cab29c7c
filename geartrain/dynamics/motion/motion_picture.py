"""A motion that shows itself: its outputs over some turns of the input."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from geartrain.errors import check_choice

if TYPE_CHECKING:
    from geartrain.dynamics.motion.motion_problem import MotionProblem


class PicturedMotion:
    """What a motion needs to draw some of its outputs."""

    train: MotionProblem
    outputs: Mapping[str, tuple[str, str]]
    tolerance: float | None
    fast: bool | None

    def plot(self, *outputs: str, turns: float = 1.0, samples: int = 2001) -> Any:
        """Angles, errors and speeds over turns of the input, as a figure that notebooks show.

        Parameters
        ----------
        *outputs : str
            Names of those to draw; all where none is given.
        turns : float
            Of the input, from the position where ideal teeth stand as declared [turn].
        samples : int
            Positions, 2 or more, both ends included.

        Returns
        -------
        matplotlib.figure.Figure
            As `geartrain.drawing.motion_figure` draws it.

        Raises
        ------
        MissingExtraError
            Without matplotlib, which the extra `plot` brings.
        QuestionError
            For an output that is not followed.

        Examples
        --------
        >>> import geartrain
        >>> motion = geartrain.load("moon-triangular").motion()
        >>> motion.plot("moon", turns=0.1).axes[-1].get_xlabel()
        'turns of crank'
        """
        from geartrain.dynamics.motion.motion_model import Motion
        from geartrain.dynamics.motion.motion_run import MotionRun

        for name in outputs:
            check_choice("output", name, list(self.outputs))
        shown = {name: self.outputs[name] for name in outputs or self.outputs}
        return MotionRun(Motion(self.train, shown, self.tolerance, self.fast), turns, samples).plot()
