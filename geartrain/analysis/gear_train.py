"""A train that answers: the whole package on one page. Each part of an answer is made when it is first requested."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, final, overload

from geartrain.errors import GearTrainError, Problem, QuestionError, check_choice
from geartrain.kinematics.planet_copies import has_copies
from geartrain.kinematics.train_kinematics import TrainKinematics
from geartrain.numerics.results import picture_maker
from geartrain.train import Train, declare
from geartrain.wings import wing

if TYPE_CHECKING:
    from pathlib import Path

    from geartrain.analysis.gearbox import Gearbox
    from geartrain.analysis.train_variants import TrainVariants
    from geartrain.dynamics import Motion, TorqueCycle, Torques
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.kinematics.answer import Answer
    from geartrain.kinematics.buildability import BuildFinding
    from geartrain.kinematics.circuits import Circuit
    from geartrain.kinematics.formulas.speed_formulas import OutputFormula
    from geartrain.kinematics.graph import Graph
    from geartrain.kinematics.phasing import MeshPhasing
    from geartrain.kinematics.speeds import Mobility
    from geartrain.kinematics.train_kinematics import Method
    from geartrain.kinematics.willis_system import WillisSystem
    from geartrain.teeth.gear_mesh import GearMesh


@final
@dataclass(frozen=True, eq=False, repr=False)
class GearTrain:
    """A declared train that answers questions. Parts are made once, when first requested, and kept.

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

    declaration: Train
    """What is declared, checked already: `geartrain.load` and `declare` make it from files and plain data."""

    def solve(self, state: str | None = None, output: str | None = None, method: Method = "auto") -> Answer:
        """Speeds and judged outputs in one state, by propagation along components and exact elimination.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        output : str, optional
            An output or a link: only the circuits that drive it are solved.
        method : {"auto", "exact", "sparse"}
            "auto" is exact unless the coupled system is too dense for it. "sparse" factorises `equations().matrix()` in
            float64 and reports residuals, condition numbers and errors; "floats" is its older name. Speeds in radians
            beside others in turns are rounded to floats in any case.

        Returns
        -------
        Answer
            Speeds by link, outputs judged against what is expected and wanted, and the verdict: a train that is locked
            or free is not an error.

        Raises
        ------
        QuestionError
            For a state, an output or a method that does not exist.
        """
        return replace(self.kinematics.solve(state, output, method), _declaration=self.declaration, _output=output)

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
            Turns of the input, above 0: the torque at every position of this run, with the ratio and the friction that
            real teeth, pins and bearings have there. Without it exact torques at mean speeds.
        samples : int
            Positions of such a run, 2 or more; corners and jumps come on top.
        of : str, optional
            The link whose torque over a turn is requested, by default the crank or input.
        on_done : callable, optional
            Called with the number of positions that have been worked out since.

        Returns
        -------
        Torques or TorqueCycle
            With a verdict: self-locking, or loads that do not balance, are not errors.

        Raises
        ------
        QuestionError
            If the train does not move, or turns or link cannot be used.
        """
        if turns is not None:
            from geartrain.dynamics.turn import train_turn

            cycle = train_turn.solve(self.mechanics, state, turns, samples, of, on_done)
            return replace(cycle, _declaration=self.declaration)
        from geartrain.dynamics.torques import train_torques

        return replace(train_torques.solve(self.mechanics, state), _declaration=self.declaration)

    def motion(
        self,
        state: str | None = None,
        outputs: Sequence[str] = (),
        without: Sequence[str] = (),
        tolerance: float | None = None,
        fast: bool | None = None,
    ) -> Motion:
        """The motion of some outputs or links with real teeth and pins: transmission functions, composed.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        outputs : sequence of str
            Outputs or links; by default all outputs, and all links of a train without any.
        without : sequence of str
            Pairs left out, so that real teeth do not contradict each other around a loop.
        tolerance : float, optional
            Read transmission functions from tables of this accuracy [pitch], several times faster.
        fast : bool, optional
            Whether compiled kernels follow the motion, the same to 1e-12 rad and about ten times as fast; by default
            where numba is installed and there are so many positions that it pays to load it. Pairs that depend on each
            other are followed without kernels.

        Returns
        -------
        Motion
            A function of the position of the input.

        Raises
        ------
        QuestionError
            If the train does not move, or a pair or output is not declared.
        """
        from geartrain.dynamics.motion.motion_model import Motion
        from geartrain.dynamics.motion.motion_problem import find_motion_problem

        wanted = self.kinematics.seen_links(state, outputs)
        motion = Motion(find_motion_problem(self.mechanics, state, without), wanted, tolerance, fast)
        motion._declaration, motion._state, motion._without = self.declaration, state, tuple(without)
        return motion

    def report(self) -> Any:
        """Everything about the train as one document: answers, structure, teeth, torques, motion, doubts and errata.

        Returns
        -------
        geartrain.report.Document
            Its text is Markdown, `geartrain.report.to_html` makes a page of it.

        Examples
        --------
        >>> import geartrain
        >>> document = geartrain.load("planetary-24-18-60").report()
        >>> [line for line in str(document).splitlines() if line.startswith("| carrier | 2/7")]
        ['| carrier | 2/7   | 0.28571429  | 1 : 3.5        |']
        """
        return picture_maker("report", "describe_train")(picture_maker("report", "collect_report")(self))

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
            What kind of picture.
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

    # -------------------------------------------------------------------------------------------- what is declared

    @classmethod
    def declare(cls, data: Mapping[str, Any]) -> GearTrain:
        """A train from plain data; circuits and cases are found no sooner than they are requested.

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

    @property
    def name(self) -> str:
        """The declared name."""
        return self.declaration.name

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the declared states; empty for a train that has only one way to run."""
        return tuple(self.declaration.states)

    @property
    def circuits(self) -> tuple[Circuit, ...]:
        """One fundamental circuit for each gear pair and coupling."""
        return self.kinematics.circuits

    @cached_property
    def graph(self) -> Graph:
        """The networkx graph in the first state: links are nodes; turning pairs, gear pairs and couplings edges.

        What they carry is said in `geartrain.analysis.build_train_graph`, which gives the graph of any state.
        """
        from geartrain.analysis.train_graph import build_train_graph

        return build_train_graph(self.mechanics, self.declaration.state_or_first(None))

    @property
    def meshes(self) -> tuple[GearMesh, ...]:
        """The gear pairs with real teeth, each with its transmission function; empty where none declares a form.

        Each is driven as in the first state that tells who drives it; `mechanics.meshes_in` has those of another.
        """
        return self.mechanics.meshes

    # ------------------------------------------------------------------------------------------ speeds and equations

    def answers(self) -> Iterator[Answer]:
        """The answer of every state, in the order declared."""
        return (self.solve(state) for state in (self.states or (None,)))

    @property
    def mobility(self) -> Mobility:
        """Degrees of freedom by count and by exact rank, with redundant and locking loops (docs/theory.md, 6)."""
        return self.kinematics.mobility

    def equations(self, state: str | None = None) -> WillisSystem:
        """The labelled Willis system of one state (docs/theory.md, 6).

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        """
        return self.kinematics.equations(state)

    def formula(self, output: str, state: str | None = None) -> OutputFormula:
        """An output as a function of the tooth counts of the wheels and the speeds of the inputs.

        Parameters
        ----------
        output : str
            One of the declared outputs.
        state : str, optional
            A declared state; None only of a train that has none.

        Returns
        -------
        OutputFormula
            As text, LaTeX or an expression of sympy, in lowest terms; exact.

        Raises
        ------
        QuestionError
            For an output or a state that does not exist, or where the inputs do not determine the output.

        Examples
        --------
        >>> import geartrain
        >>> train = geartrain.load("planetary-24-18-60")
        >>> train.formula("carrier").text
        'carrier = z_s/(z_s + z_ring) · sun'
        """
        from geartrain.kinematics.formulas.speed_formulas import speed_formulas

        found = next(speed_formulas(self.declaration, self.declaration.single_state(state), (output,)), None)
        if found is None:
            what, why = f"output '{output}' has no formula", "the inputs do not determine it"
            raise QuestionError(Problem(what, why, "see `geartrain check` for what is missing"))
        return found

    def variants(
        self, counts: Mapping[str, Iterable[int]], outputs: Sequence[str] = (), state: str | None = None
    ) -> TrainVariants:
        """Outputs of all trains that have some of these tooth counts: every combination, by exact formulas at once.

        Parameters
        ----------
        counts : mapping of str to iterable of int
            Counts to try, by wheel.
        outputs : sequence of str
            Some outputs; by default all.
        state : str, optional
            A declared state; None only of a train that has none.

        Returns
        -------
        TrainVariants
            A table in float64 with bounds of its errors; `exact` gives fractions.

        Raises
        ------
        QuestionError
            For wheels, outputs or states that do not exist, and for more than 10^8 combinations.

        Examples
        --------
        >>> import geartrain
        >>> found = geartrain.load("freeth-2021").variants({"b1": range(220, 228)}, ["mars"])
        >>> len(found), found["b1"][:3].tolist(), found.exact(0, "mars") is not None
        (8, [220, 221, 222], True)
        """
        from geartrain.analysis.train_variants import find_variants

        return find_variants(self.declaration, self.declaration.single_state(state), counts, outputs)

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

        return find_gearbox(self.mechanics, output)

    # -------------------------------------------------------------------------------------------- whether it is sound

    @cached_property
    def build_findings(self) -> tuple[BuildFinding, ...]:
        """What of the train cannot be built, and what is unwise, by the declaration alone (docs/buildability.md)."""
        from geartrain.dynamics.train_check import find_build_findings

        return find_build_findings(self.mechanics)

    @cached_property
    def closure(self) -> MeshPhasing:
        """Whether the teeth of every loop meet, where positions of axes are declared, and angles to put wheels in."""
        from geartrain.kinematics.phasing import find_phasing

        backlash = {mesh.name: mesh.backlash for mesh in self.mechanics.teeth}
        found = find_phasing(self.declaration, self.kinematics.tree, self.circuits, backlash)
        _ = found.kind  # judged here, so that its line at the prompt computes nothing
        return found

    # ------------------------------------------------------------------------------------ loads, and motion in time

    def driven(self, load: str, source: str, state: str | None = None) -> Torques:
        """Torques while a unit of power leaves at one link, driven from another: efficiency, or self-locking.

        Parameters
        ----------
        load, source : str
            Two links: where the power leaves, and where it enters.
        state : str, optional
            A declared state; None only of a train that has none.
        """
        from geartrain.dynamics.torques import train_torques

        found = train_torques.solve_driven(self.mechanics, load, source, state)
        return replace(found, _declaration=self.declaration)

    def strength(
        self,
        state: str | None = None,
        *,
        turns: float | None = None,
        years: float | None = None,
        wear: tuple[float, float] | None = None,
        over: float | None = None,
    ) -> Any:
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
        geartrain.simulation.TrainStrength
            With a verdict: where torques do not follow from the loads there is nothing else.

        Raises
        ------
        QuestionError
            If loads have no unit, time is given twice or cannot be calculated, or K is not a range.
        """
        strength = wing("simulation.strength.train_strength")
        found = strength.solve_strength(self.mechanics, state, strength.Service(turns, years, wear), over)
        return replace(found, _declaration=self.declaration)

    def dynamics(
        self,
        rate: str | float | None = None,
        turns: float = 10.0,
        state: str | None = None,
        *,
        skip: float = 1.0,
        steps: int | None = None,
        restitution: float | None = None,
        outputs: Sequence[str] = (),
        without: Sequence[str] = (),
        samples: int | None = None,
        fast: bool | None = None,
        on_done: Callable[[float], object] = lambda _: None,
        model: Literal["rigid", "compliant"] = "rigid",
    ) -> Any:
        """Motion in time: inertia, backlash, impacts, drag and friction (docs/dynamics.md).

        Rigid teeth by nonsmooth time stepping; teeth that yield by their stiffness and damping, with peaks of torque
        and dynamic factors in place of impulses.

        Two runs are made, of steps h and h/2; what differs between them is marked, and all else is of the second.

        Parameters
        ----------
        rate : str or float, optional
            Speed of the first input that turns, the way it is declared to, as text such as "1 turn/s" or a number
            [rad/s]; by default the declared drive.
        turns : float
            Turns of that input that are counted, in its mean motion.
        state : str, optional
            A declared state; None only of a train that has none.
        skip : float
            Turns before, which are not counted.
        steps : int, optional
            Steps of the first run in a turn; by default 200 in the shortest period of a pair.
        restitution : float, optional
            Of all impacts, in place of what is declared.
        outputs : sequence of str
            Outputs or links; by default all outputs, and all links of a train without any.
        without : sequence of str
            Pairs left out, so that real teeth do not contradict each other around a loop.
        samples : int, optional
            Samples that are kept; by default 12 in the shortest period of a pair, 40000 at most.
        fast : bool, optional
            Whether kernels are compiled, by the extra `fast`; by default if the run is long and numba is installed.
        on_done : callable
            Called with the share of the work that each stretch adds [0 to 1]. Where it returns True, no more is done,
            and what was found in the first run is reported.
        model : {"rigid", "compliant"}
            Whether teeth yield; then each pair that is not to keep its ratio needs a `stiffness`.

        Returns
        -------
        geartrain.simulation.TimeRun
            Angles, speeds, torques, shares of time apart, impacts, energy.

        Raises
        ------
        QuestionError
            If the train does not move, nothing says how fast, a link that can move by itself has no inertia, or nothing
            says how stiff teeth are that are to yield.
        GearTrainError
            If redundant loops have teeth that cannot turn together, or friction locks teeth.
        """
        driven = wing("simulation.time.train_in_time").DrivenTrain(
            self.mechanics, state, rate, restitution, outputs, without
        )
        found = driven.study(model, turns, skip, steps=steps, samples=samples, fast=fast).run(on_done)
        return replace(found, _declaration=self.declaration, _without=tuple(without))

    def simulation(
        self,
        rate: str | float | None = None,
        state: str | None = None,
        *,
        step: float | None = None,
        restitution: float | None = None,
        outputs: Sequence[str] = (),
        without: Sequence[str] = (),
        fast: bool | None = False,
    ) -> Any:
        """A train that moves in time step by step, and may be steered on the way; the steps are those of `dynamics`.

        Parameters
        ----------
        rate, state, restitution, outputs, without
            As of `dynamics`; teeth are rigid.
        step : float, optional
            Length of a step [s]; by default that of the finer run of `dynamics`.
        fast : bool, optional
            Whether kernels are compiled, by the extra `fast`; None: if numba is installed.

        Returns
        -------
        geartrain.simulation.Simulation
            At time 0.

        Raises
        ------
        QuestionError
            As from `dynamics`.
        GearTrainError
            As from `dynamics`.
        """
        driven = wing("simulation.time.train_in_time").DrivenTrain(
            self.mechanics, state, rate, restitution, outputs, without
        )
        return driven.simulation(step, fast)

    def _driven(self, *requested: Any) -> Any:
        """The train driven in time in one state, from the wing `simulation`."""
        return wing("simulation.time.train_in_time").DrivenTrain(self.mechanics, *requested)

    # ----------------------------------------------------------------------------------------------------- other trains

    def with_teeth(self, counts: Mapping[str, int] | None = None, **more: int) -> GearTrain:
        """The train with other tooth counts on some wheels.

        Parameters
        ----------
        counts : mapping of str to int, optional
            Tooth count by wheel.
        **more : int
            The same for wheels whose names are words of Python.

        Returns
        -------
        GearTrain
            A new one; what is expected of outputs stays as declared.

        Raises
        ------
        QuestionError
            For wheels that do not exist, and for what is not a tooth count.

        Examples
        --------
        >>> import geartrain
        >>> geartrain.load("planetary-24-18-60").with_teeth(s=30, p=15).solve()["carrier"]
        Fraction(1, 3)
        """
        from geartrain.kinematics.formulas import with_counts

        return GearTrain(with_counts(self.declaration, {**(counts or {}), **more}))

    def with_changes(self, changes: Mapping[str, Any] | None = None, **more: Any) -> GearTrain:
        """The train with other values of any keys of its declaration.

        Parameters
        ----------
        changes : mapping, optional
            Keys of a declaration with their values, laid over this one as by `extends`: entries of `links`, `gears`,
            `outputs` and the like are merged by name, other values such as `inputs` and `tooth_form` replace the old
            ones, None unsets a key, and `remove` takes entries away.
        **more : object
            The same for keys as words of Python.

        Returns
        -------
        GearTrain
            A new one; what is expected of outputs stays as declared, and states that declare inputs keep them.

        Raises
        ------
        DeclarationError
            For changes that a declaration does not allow.

        Examples
        --------
        >>> import geartrain
        >>> train = geartrain.load("planetary-24-18-60-involute")
        >>> [round(float(train.with_changes(friction=mu).driven("carrier", "sun").efficiency), 4) for mu in (0, 0.1)]
        [1.0, 0.9785]
        >>> train.with_changes(inputs={"carrier": 2}).solve()["sun"]
        Fraction(7, 1)
        """
        from geartrain.train.inheritance import change_declaration

        return GearTrain(change_declaration(self.declaration, {**(changes or {}), **more}))

    def with_tooth_form(self, form: str, pairs: Sequence[str] = (), **parameters: Any) -> GearTrain:
        """Return the train with teeth of another form.

        Parameters
        ----------
        form : str
            Name of the form: "involute", "cycloidal", "triangular" or another of `geartrain mesh -h`; "ideal" for teeth
            without errors and losses.
        pairs : sequence of str
            Names of gear pairs; by default all pairs of the train, also those that declare a form of their own.
        **parameters : object
            Parameters of the form as a declaration writes them, such as ``pressure_angle="25 deg"``; by default those
            of the form. Triangular teeth have no defaults in a declaration. Here their `half_angle` is 30 deg, the
            equilateral tooth of figures 3 to 5 of F. Sorge, "A note on the mechanics of ancient gear systems". Without
            another clearance their `window` is 0.5, the middle between jamming and loss of contact (docs/teeth.md,
            section 5).

        Returns
        -------
        GearTrain
            A new train.

        Raises
        ------
        QuestionError
            For a form or a pair that does not exist.
        DeclarationError
            For a parameter that the form does not have, or that it cannot have.

        Examples
        --------
        >>> import geartrain
        >>> train = geartrain.load("planetary-24-18-60").with_tooth_form("triangular")
        >>> [mesh.verdict.text for mesh in train.meshes]
        ['the wheels turn', 'the wheels turn']
        >>> train.with_tooth_form("involute", pairs=["s~p"], pressure_angle="25 deg").meshes[0].form
        'involute'
        """
        from geartrain.teeth.any_tooth_form import tooth_forms

        known = tooth_forms()
        check_choice("tooth form", form, known)
        declared = {gear.name: gear for gear in self.declaration.gears}
        for pair in pairs:
            check_choice("gear pair", pair, declared)
        teeth = {"form": form, **known[form].with_defaults(parameters)}
        own = None if not pairs else teeth
        changes: dict[str, Any] = {} if pairs else {"tooth_form": teeth}
        changes["gears"] = [
            {**({"id": gear.id} if gear.id else {}), "pair": list(gear.pair), "tooth_form": own}
            for gear in (declared[name] for name in pairs or declared)
        ]
        return self.with_changes(changes)

    @property
    def unfolded(self) -> GearTrain:
        """The train with each of its equal planets declared; itself where no link stands for several (`copies`)."""
        # not kept where it is the train itself: that would hold itself
        return self._unfolded if has_copies(self.declaration) else self

    @cached_property
    def _unfolded(self) -> GearTrain:
        return GearTrain(self.mechanics.unfolded.declaration)

    # ----------------------------------------------------------------------------------------------------------- parts

    @cached_property
    def kinematics(self) -> TrainKinematics:
        """What follows without teeth: tree, signs of axes, cases, gridlock, speeds in floats, sensitivity."""
        return TrainKinematics(self.declaration)

    @cached_property
    def mechanics(self) -> TrainMechanics:
        """What follows from teeth and loads: who drives each pair, faults, pins, the case of torques."""
        from geartrain.dynamics.train_mechanics import TrainMechanics

        return TrainMechanics(self.kinematics)

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

    def _repr_html_(self) -> str:
        declared = self.declaration
        title = f"<p><b>{html.escape(declared.name)}</b> {html.escape(declared.title)}</p>"
        return title + "".join(answer._repr_html_() for answer in self.answers())


def load(source: str | Path | Mapping[str, Any]) -> GearTrain:
    """A train from a YAML file, the name of a shipped train, YAML text, or plain data.

    All circuits and cases are found here, so that whatever is wrong with the declaration is reported at once.

    Parameters
    ----------
    source : str, Path or mapping
        A path; the name of a shipped train, see `geartrain.shipped`; YAML of several lines; or its keys as plain data.

    Returns
    -------
    GearTrain
        Only its circuits and cases are worked out yet.

    Raises
    ------
    DeclarationError
        With the place (`file:line`) of everything that is wrong, and what to do about it.

    Examples
    --------
    A planetary gear of 24, 18 and 60 teeth whose ring is held: the carrier makes 24 / (24 + 60) of a turn.

    >>> train = load("planetary-24-18-60")
    >>> train.solve()["carrier"]
    Fraction(2, 7)
    """
    from geartrain.train.declaration_files import read_declaration

    train = GearTrain(read_declaration(source))
    _ = train.circuits, train.kinematics.cases
    return train
