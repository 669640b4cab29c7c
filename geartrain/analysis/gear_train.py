"""A train that answers: the whole corridor on one page, each part made only when asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

from geartrain.analysis.changed_declaration import ChangeableTrain
from geartrain.errors import GearTrainError
from geartrain.numerics.result_picture import picture_maker
from geartrain.train import declare

if TYPE_CHECKING:
    from geartrain.analysis.gear_series import GearSearch
    from geartrain.analysis.gearbox import Gearbox
    from geartrain.kinematics.graph import Graph
    from geartrain.kinematics.phasing import MeshPhasing


class GearTrain(ChangeableTrain):
    """A declared train that answers questions. Parts are made once, when first asked for, and kept.

    Parameters
    ----------
    declaration : Train
        What is declared, checked already: `geartrain.load` and `declare` make it from files and plain data.

    Raises
    ------
    DeclarationError
        By the first question that needs a part which the declaration cannot give, such as a tree of turning pairs.

    See Also
    --------
    load : a train from a file or by name

    Notes
    -----
    Speeds follow from the Willis equation of each gear pair, docs/theory.md (4); torques from the transpose of that
    system, docs/torques.md (1) to (3); motion with real teeth from their transmission functions, composed in the
    solved order of the train, docs/motion.md (3).

    Examples
    --------
    A pinion of 20 turns a wheel of 60, against a torque of 3 on it; teeth without losses pass on the whole power.

    >>> train = GearTrain.declare({"links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 60}}},
    ...     "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    ...     "gears": [{"pair": ["p", "w"]}], "inputs": {"a": 1}, "loads": {"b": 3}})
    >>> train.solve()["b"]
    Fraction(-1, 3)
    >>> train.mobility.by_rank, [circuit.carrier for circuit in train.circuits]
    (1, ['frame'])
    >>> train.torques().external["a"]
    Fraction(1, 1)
    """

    @classmethod
    def declare(cls, data: Mapping[str, Any]) -> GearTrain:
        """A train from plain data; circuits and cases are found no sooner than they are asked for.

        Parameters
        ----------
        data : mapping
            The keys of a YAML declaration, docs/reference.md.

        Raises
        ------
        DeclarationError
            With the place of everything that is wrong.
        """
        if "extends" in data or "reconstruct" in data:  # evidence is refused there
            from geartrain.train.declaration_files import read_declaration

            return cls(read_declaration(data))
        return cls(declare(data))

    @cached_property
    def graph(self) -> Graph:
        """The networkx graph in the first state; `graph_in` says what its nodes and edges carry."""
        return self.graph_in(self.state_or_first(None))

    def graph_in(self, state: str | None = None) -> Graph:
        """The train as a networkx MultiGraph: links are nodes; turning pairs, gear pairs and couplings edges.

        Nodes carry `declared`, `frame` (True of the one at rest), `wheels`, `reference` (the link that holds its axis)
        and `speed`; edges `kind`, `label`, `declared`, `axis`, and pairs also `circuit`, `carrier`, `ratio`, `form`,
        `mesh` and `efficiency` (docs/library.md, 2). All but what is declared is worked out when it is read.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        """
        from geartrain.analysis.train_graph import build_train_graph

        return build_train_graph(self, self._case(state).state)

    def draw(
        self,
        kind: Literal["plan", "stick", "graph", "lever", "dials"] = "plan",
        state: str | None = None,
        turns: Fraction | int = 0,
        labels: bool = True,
        outputs: Sequence[str] = (),
    ) -> Any:
        """A picture of the train, as a figure of matplotlib that notebooks show: `geartrain.drawing.picture`.

        Parameters
        ----------
        kind : {"plan", "stick", "graph", "lever", "dials"}
            How.
        state : str, optional
            Its name; by default the first, of "lever" all.
        turns : Fraction
            Of the input since the pose where all angles are zero [turn]; counts for "plan" and "dials".
        labels : bool
            Names and numbers beside what is drawn.
        outputs : sequence of str
            Those whose dials are drawn; by default all.
        """
        return picture_maker("drawing", "picture")(self, kind, state, Fraction(turns), labels, outputs)

    def view(self, state: str | None = None, height: int = 620) -> Any:
        """The train as it turns, for a notebook: `geartrain.viewer.EmbeddedPage`.

        Parameters
        ----------
        state : str, optional
            One of its states; by default all, to be chosen among.
        height : int
            Of the frame [px].
        """
        return picture_maker("viewer", "EmbeddedPage")(self, state, height)

    @cached_property
    def closure(self) -> MeshPhasing:
        """Whether the teeth of every loop meet, where positions of axes are declared, and angles to put wheels in."""
        from geartrain.kinematics.phasing import find_phasing

        plays = {mesh.name: mesh.play for mesh in self._teeth}
        return find_phasing(self.declaration, self.tree, self.circuits, plays)

    def gearbox(self, output: str | None = None) -> Gearbox:
        """All states of a train with clutches: ratios, steps, speeds, slip and torques of elements, circulating power.

        Parameters
        ----------
        output : str, optional
            One of the declared outputs, by default the first that is not the input.

        Returns
        -------
        Gearbox
            A state that is free or locked is one like others: neutral, and park.

        Raises
        ------
        QuestionError
            For a train that declares no clutches, no states, or no input that turns.

        Examples
        --------
        >>> import geartrain
        >>> box = geartrain.load("zf-8hp70").gearbox()
        >>> round(float(box.spread), 3), box.states[0].engaged, [shift for shift in box.shifts if shift.is_double]
        (7.043, ('A', 'B', 'C'), [])
        """
        from geartrain.analysis.gearbox import find_gearbox

        return find_gearbox(self, output)

    def gear_search(
        self, output: str | None = None, gears: int = 0, steps: tuple[float, float] = (1.05, 2.0), single: bool = False
    ) -> GearSearch:
        """Every gear that closing elements gives, declared or not, and series of gears.

        Parameters
        ----------
        output : str, optional
            One of the declared outputs, by default the first that is not the input.
        gears : int
            Forward gears of a series; below 2 none is looked for.
        steps : tuple of float
            Least and greatest ratio of a gear over the next.
        single : bool
            Only shifts in which one element opens and one closes.

        Returns
        -------
        GearSearch
            Complete and exact: all ways to close as many elements as are needed, and no more.

        Raises
        ------
        QuestionError
            As of `gearbox`, and where there are too many ways.

        Examples
        --------
        >>> import geartrain
        >>> found = geartrain.load("simpson-set").gear_search(gears=3, steps=(1.4, 1.8))
        >>> [round(float(ratio), 3) for ratio in found.evenest.ratios]
        [2.455, 1.455, 1.0]
        """
        from geartrain.analysis.gear_series import find_gears

        return find_gears(self, output, gears, steps, single)

    def __repr__(self) -> str:
        declared = self.declaration
        links, wheels = len(declared.links), len(declared.wheels)
        size = f"{links} links, {wheels} wheels" + (f", {len(self.states)} states" if self.states else "")
        return f"<GearTrain {self.name}: {size}; {self._verdicts()}>"

    def _verdicts(self) -> str:
        try:
            return " or ".join(dict.fromkeys(answer.verdict.kind for answer in self.answers()))
        except GearTrainError as error:
            return error.problems[0].what
