"""Gear train with methods for all computations of the package. Results are computed at the first request and cached."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, final, overload

from geartrain.errors import GearTrainError, MissingExtraError, Problem, QuestionError, check_choice
from geartrain.kinematics.planet_copies import has_copies
from geartrain.kinematics.train_kinematics import TrainKinematics
from geartrain.numerics.results import imported_function
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
    from geartrain.teeth.given_transmission import TransmissionProtocol


@final
@dataclass(frozen=True, eq=False, repr=False)
class GearTrain:
    """Declared train with methods for all computations. Results are computed at the first request and cached.

    Raises
    ------
    DeclarationError
        If a method needs a part that the declaration does not determine, such as the tree of turning pairs.

    See Also
    --------
    load : Load a train from a file or by name.

    Notes
    -----
    Speeds follow from the Willis equation of each gear pair, equation (4) of docs/theory.md. Torques follow from the
    transpose of that system, equations (1) to (3) of docs/torques.md. Motion with tooth forms is composed from their
    transmission functions in the order of solution of the train, equation (3) of docs/motion.md.

    Examples
    --------
    A pinion with 20 teeth drives a wheel with 60 teeth against a torque of 3, without losses:

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
    """Validated declaration. `geartrain.load` and `declare` build it from files and plain data."""

    def solve(self, state: str | None = None, output: str | None = None, method: Method = "auto") -> Answer:
        """Solve for the speeds in one state, by default by propagation and exact elimination, and evaluate the outputs.

        Parameters
        ----------
        state : str, optional
            A declared state; None only if the train has no states.
        output : str, optional
            Name of an output or a link; only the circuits that can affect it are solved.
        method : {"auto", "exact", "sparse"}
            "auto" is "exact" unless the coupled system is too dense. "sparse" factorises `equations().matrix()` in
            float64 and reports residuals, condition numbers and errors; "floats" is an older name of "sparse". If a
            train contains speeds in radians and speeds in turns, every method returns all speeds as floats.

        Returns
        -------
        Answer
            Speeds by link, outputs compared with their expected values, and the verdict. A locked or free train is not
            an error.

        Raises
        ------
        QuestionError
            If the state, the output or the method does not exist.
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
        """Compute the torques on links and pairs, and the power flow, under the loads of one state.

        The torques are mean values, or values at the positions of a run over several revolutions.

        Parameters
        ----------
        state : str, optional
            A declared state; None only if the train has no states.
        turns : float, optional
            Revolutions of the input in the run, greater than 0. The torque is computed at every position of the run,
            with the instantaneous ratio and friction of teeth, pins and bearings. By default, torques are computed
            exactly at the mean speeds.
        samples : int
            Number of positions in the run, at least 2. Positions at kinks and jumps of the ratios are added.
        of : str, optional
            Link whose torque over the run is requested; by default the crank, or else the input.
        on_done : callable, optional
            Progress function, called with the number of positions computed since the last call.

        Returns
        -------
        Torques or TorqueCycle
            Result with a verdict. Self-locking, or loads that do not balance, are not errors.

        Raises
        ------
        QuestionError
            If the train does not move, or if the number of revolutions or the link is invalid.
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
    ) -> Motion:
        """Compute the motion of outputs or links, including the transmission errors of teeth and pins, by composition
        of transmission functions.

        Parameters
        ----------
        state : str, optional
            A declared state; None only if the train has no states.
        outputs : sequence of str
            Names of outputs or links; by default all outputs, or all links if the train has no outputs.
        without : sequence of str
            Names of pairs to omit. This is necessary if the transmission errors of the pairs in a loop are
            incompatible.

        Returns
        -------
        Motion
            Motion as a function of the position of the input.

        Raises
        ------
        QuestionError
            If the train does not move, if a pair or output is not declared, or if clutches drive a requested output
            stepwise.
        """
        from geartrain.dynamics.motion.motion_model import Motion
        from geartrain.dynamics.motion.motion_problem import find_motion_problem

        problem = find_motion_problem(self.mechanics, state, without, steps=True)
        wanted = problem.without_steps(self.kinematics.seen_links(state, outputs), outputs)
        motion = Motion(problem, wanted)
        motion._declaration, motion._state, motion._without = self.declaration, state, tuple(without)
        motion._shown = tuple(wanted) if outputs else self.declaration.dial_outputs(tuple(wanted))
        return motion

    def report(self) -> Any:
        """Build a report on the train, with speeds, structure, teeth, torques, motion, uncertain data and errata.

        Returns
        -------
        geartrain.report.Document
            Document whose text is Markdown; `geartrain.report.to_html` converts it to HTML.

        Examples
        --------
        >>> import geartrain
        >>> document = geartrain.load("planetary-24-18-60").report()
        >>> [line for line in str(document).splitlines() if line.startswith("| carrier | 2/7")]
        ['| carrier | 2/7   | 0.28571429  | 1 : 3.5        |']
        """
        return imported_function("report.train_report", "describe_train")(
            imported_function("report.train_data", "collect_report")(self)
        )

    def draw(
        self,
        kind: Literal["plan", "stick", "graph", "lever", "dials"] = "plan",
        state: str | None = None,
        turns: Fraction | int = 0,
        labels: bool = True,
        outputs: Sequence[str] = (),
    ) -> Any:
        """Draw the train as a matplotlib figure, which notebooks display; see `geartrain.drawing.picture`.

        Parameters
        ----------
        kind : {"plan", "stick", "graph", "lever", "dials"}
            Kind of picture.
        state : str, optional
            Name of a state; by default the first state, or all states for "lever".
        turns : Fraction
            Revolutions of the input from the pose in which all angles are 0. Only "plan" and "dials" use this
            parameter.
        labels : bool
            True to add names and tooth counts.
        outputs : sequence of str
            Outputs whose dials are drawn; by default all outputs.
        """
        return imported_function("drawing", "picture")(self, kind, state, Fraction(turns), labels, outputs)

    def view(self, state: str | None = None, height: int = 620) -> Any:
        """Return an animated view of the train for a notebook.

        Parameters
        ----------
        state : str, optional
            Name of a state; by default, all states can be selected in the view.
        height : int
            Height of the frame [px].
        """
        return imported_function("viewer.viewer_page", "EmbeddedPage")(self, state, height)

    # -------------------------------------------------------------------------------------------- what is declared

    @classmethod
    def declare(cls, data: Mapping[str, Any]) -> GearTrain:
        """Build a train from plain data. The circuits, and the speeds and loads prescribed in each state, are computed
        when they are first requested.

        Parameters
        ----------
        data : mapping
            Declaration with the same keys as in YAML (docs/reference.md).

        Raises
        ------
        DeclarationError
            If the data are invalid. The message gives the location of every error.
        """
        if "extends" in data or "reconstruct" in data:  # `read_declaration` rejects evidence
            from geartrain.train.declaration_files import read_declaration

            return cls(read_declaration(data))
        return cls(declare(data))

    @property
    def name(self) -> str:
        """Declared name of the train."""
        return self.declaration.name

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the declared states; empty if the train declares no states."""
        return tuple(self.declaration.states)

    @property
    def circuits(self) -> tuple[Circuit, ...]:
        """Fundamental circuits, one for each gear pair and coupling."""
        return self.kinematics.circuits

    @cached_property
    def graph(self) -> Graph:
        """Kinematic graph of the first state as a networkx graph, in which links are nodes, and turning pairs, gear
        pairs and couplings are edges.

        `geartrain.analysis.build_train_graph` documents the attributes, and builds the graph of any state.
        """
        from geartrain.analysis.train_graph import build_train_graph

        return build_train_graph(self.mechanics, self.declaration.state_or_first(None))

    @property
    def meshes(self) -> tuple[GearMesh, ...]:
        """Gear pairs with a tooth form, each with its transmission function; empty if no form is declared.

        The driving wheel of a pair is taken from the first state in which it is determined. `mechanics.meshes_in`
        returns the pairs with the driving wheels in another state.
        """
        return self.mechanics.meshes

    # ------------------------------------------------------------------------------------------ speeds and equations

    def answers(self) -> Iterator[Answer]:
        """Yield the solved speeds of each declared state in order, or of the train if it declares no states."""
        return (self.solve(state) for state in (self.states or (None,)))

    @property
    def mobility(self) -> Mobility:
        """Mobility of the train by counting and by exact rank, with redundant and locking loops (docs/theory.md, 6)."""
        return self.kinematics.mobility

    def equations(self, state: str | None = None) -> WillisSystem:
        """Return the Willis equations of one state as a linear system with labelled rows and columns
        (docs/theory.md, 6).

        Parameters
        ----------
        state : str, optional
            A declared state; None only if the train has no states.
        """
        return self.kinematics.equations(state)

    def formula(self, output: str, state: str | None = None) -> OutputFormula:
        """Return the speed of an output as a function of the tooth counts of the wheels and the speeds of the inputs.

        Parameters
        ----------
        output : str
            Name of an output.
        state : str, optional
            A declared state; None only if the train has no states.

        Returns
        -------
        OutputFormula
            Exact formula in lowest terms, available as plain text, LaTeX or a sympy expression.

        Raises
        ------
        QuestionError
            If the output or the state does not exist, or if the inputs do not determine the output.

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
            raise QuestionError(Problem(what, why, "`geartrain check FILE` shows which inputs are missing"))
        return found

    def variants(
        self, counts: Mapping[str, Iterable[int]], outputs: Sequence[str] = (), state: str | None = None
    ) -> TrainVariants:
        """Compute the speeds of outputs for all combinations of the given tooth counts at once, by exact formulas.

        Parameters
        ----------
        counts : mapping of str to iterable of int
            Tooth counts to be evaluated, by name of the wheel.
        outputs : sequence of str
            Names of outputs; by default all outputs.
        state : str, optional
            A declared state; None only if the train has no states.

        Returns
        -------
        TrainVariants
            Table in float64 with error bounds; its method `exact` returns fractions.

        Raises
        ------
        QuestionError
            If a wheel, output or state does not exist, or if there are more than 10^8 combinations.

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
        """Compute ratios, steps, speeds, slip, torques and recirculating power of all states of a train with clutches.

        Parameters
        ----------
        output : str, optional
            Name of an output; by default the first output that is not the input.

        Returns
        -------
        Gearbox
            Results of all states, including free states (neutral) and locked states (park).

        Raises
        ------
        QuestionError
            If the train declares no clutches, no states, no turning input, or no output other than the input.

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
        """Findings on parts that cannot be built or whose design is inadvisable (docs/buildability.md)."""
        from geartrain.dynamics.train_check import find_build_findings

        return find_build_findings(self.mechanics)

    @cached_property
    def closure(self) -> MeshPhasing:
        """Assembly condition: phases of the teeth in every loop at the declared axes, and mounting angles of wheels."""
        from geartrain.kinematics.phasing import find_phasing

        backlash = {mesh.name: mesh.backlash for mesh in self.mechanics.teeth}
        return find_phasing(self.declaration, self.kinematics.tree, self.circuits, backlash)

    # ------------------------------------------------------------------------------------ loads, and motion in time

    def driven(self, load: str, source: str, state: str | None = None) -> Torques:
        """Compute the torques for the case that the link `source` drives and unit power leaves the train at the link
        `load`.

        The result contains the efficiency in this direction, or reports self-locking.

        Parameters
        ----------
        load, source : str
            Links at which the power leaves and enters the train, respectively.
        state : str, optional
            A declared state; None only if the train has no states.
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
        """Compute contact pressures, root stresses, safety factors and wear under the loads of one state
        (docs/strength.md).

        Parameters
        ----------
        state : str, optional
            A declared state; None only if the train has no states.
        turns : float, optional
            Revolutions of the input over which wear accumulates, greater than 0.
        years : float, optional
            Duration over which wear accumulates, in years of 365.25 days; the unit of speeds or a `rate` must determine
            the speed of the train.
        wear : tuple of float, optional
            Minimum and maximum wear coefficient K of Archard's law; by default 1e-7 to 1e-3.
        over : float, optional
            Revolutions of the input in a run with the instantaneous ratios and friction of teeth and pins. Stresses are
            then computed from the maximum torque of each pair in this run; by default, from the mean torque.

        Returns
        -------
        geartrain.simulation.TrainStrength
            Result with a verdict. If the loads do not determine the torques, the other fields are empty.

        Raises
        ------
        QuestionError
            If loads have no unit, if both `turns` and `years` are given, if the duration cannot be calculated, or if
            `wear` is not a range.
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
        """Simulate the motion in the time domain with inertia, backlash, impacts, drag and friction (docs/dynamics.md).

        Rigid teeth are simulated by nonsmooth time stepping. Compliant teeth have stiffness and damping; their results
        are peak torques and dynamic factors instead of impulses. The simulation is run with the time steps h and h/2.
        Results that differ between the two runs are marked. All reported results are from the second run.

        Parameters
        ----------
        rate : str or float, optional
            Speed of the first turning input, in its declared sense, as a string such as "1 turn/s" or a number [rad/s];
            by default, the declared drive is used.
        turns : float
            Number of revolutions of the mean motion of this input that are evaluated.
        state : str, optional
            A declared state; None only if the train has no states.
        skip : float
            Number of preceding revolutions that are not evaluated.
        steps : int, optional
            Number of time steps per revolution in the first run; by default, 200 per shortest period of a pair.
        restitution : float, optional
            Coefficient of restitution of all impacts, which replaces the declared values.
        outputs : sequence of str
            Names of outputs or links; by default all outputs, or all links if the train has no outputs.
        without : sequence of str
            Names of pairs to omit. This is necessary if the transmission errors of the pairs in a loop are
            incompatible.
        samples : int, optional
            Number of samples that are recorded; by default 12 per shortest period of a pair, at most 40000.
        fast : bool, optional
            True to compile kernels (extra `fast`). By default, kernels are compiled if the run is long and numba is
            installed.
        on_done : callable
            Progress function, called with the fraction of the work done since the last call. If it returns True, the
            simulation stops and the results of the first run are reported.
        model : {"rigid", "compliant"}
            Model of the teeth. With "compliant", a stiffness must be known for each pair that the rigid model treats as
            a contact.

        Returns
        -------
        geartrain.simulation.TimeRun
            Angles, speeds, torques, impacts, energies, and the fractions of time in which teeth are not in contact.

        Raises
        ------
        QuestionError
            If the train does not move, if its speed is not given, if a link that can move by itself has no inertia, or
            if the stiffness of compliant teeth is not given.
        GearTrainError
            If the teeth of redundant loops cannot turn together, or if friction locks teeth.
        """
        driven = self._driven(state, rate, restitution, outputs, without)
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
        """Build a simulation that is advanced step by step and can be controlled between steps. The time-stepping
        method is that of `dynamics`.

        Parameters
        ----------
        rate, state, restitution, outputs, without
            Parameters with the same meaning as in `dynamics`. The teeth are rigid.
        step : float, optional
            Length of a time step [s]; by default the time step of the second run of `dynamics`.
        fast : bool, optional
            True to compile kernels (extra `fast`), None to compile them if numba is installed; by default, they are not
            compiled.

        Returns
        -------
        geartrain.simulation.Simulation
            Simulation at time 0.

        Raises
        ------
        QuestionError
            Under the conditions listed for `dynamics`.
        GearTrainError
            Under the conditions listed for `dynamics`.
        """
        return self._driven(state, rate, restitution, outputs, without).simulation(step, fast)

    def _driven(self, *requested: Any) -> Any:
        return wing("simulation.time.train_in_time").DrivenTrain(self.mechanics, *requested)

    # ----------------------------------------------------------------------------------------------------- other trains

    def with_teeth(self, counts: Mapping[str, int] | None = None, **more: int) -> GearTrain:
        """Return a copy of the train with other tooth counts on some wheels.

        Parameters
        ----------
        counts : mapping of str to int, optional
            Tooth counts by name of the wheel.
        **more : int
            Tooth counts of wheels whose names are Python identifiers.

        Returns
        -------
        GearTrain
            New train. Expected values of outputs remain as declared.

        Raises
        ------
        QuestionError
            If a wheel does not exist or a value is not a tooth count.

        Examples
        --------
        >>> import geartrain
        >>> geartrain.load("planetary-24-18-60").with_teeth(s=30, p=15).solve()["carrier"]
        Fraction(1, 3)
        """
        from geartrain.kinematics.formulas import with_counts

        return GearTrain(with_counts(self.declaration, {**(counts or {}), **more}))

    def with_changes(self, changes: Mapping[str, Any] | None = None, **more: Any) -> GearTrain:
        """Return a copy of the train with some keys of its declaration changed.

        Parameters
        ----------
        changes : mapping, optional
            New values by key, merged in the same way as by `extends`: entries of `links`, `gears`, `outputs` and the
            like are merged by name; other values, such as `inputs` and `tooth_form`, are replaced; None deletes a key;
            `remove` deletes entries.
        **more : object
            Further changes, as keyword arguments.

        Returns
        -------
        GearTrain
            New train. Expected values of outputs remain as declared, and so do the inputs of states that declare their
            own.

        Raises
        ------
        DeclarationError
            If the changed declaration is invalid.

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

    def with_tooth_form(
        self, form: str | TransmissionProtocol, pairs: Sequence[str] = (), **parameters: Any
    ) -> GearTrain:
        """Return a copy of the train with teeth of another form, or with a given transmission function.

        Parameters
        ----------
        form : str or TransmissionProtocol
            Name of the form: "involute", "cycloidal", "triangular" or another one listed by `geartrain mesh -h`;
            "ideal" for teeth without errors and losses. It can also be a transmission function that replaces the teeth,
            an object with `ratio`, `period`, `error` and `speed` (docs/library.md); the parameters are then those of
            the form "table".
        pairs : sequence of str
            Names of gear pairs; by default all pairs of the train, including those that declare a form.
        **parameters : object
            Parameters of the form as in a declaration, such as ``pressure_angle="25 deg"``; other parameters have the
            defaults of the form. Triangular teeth have no defaults in a declaration; here the default of `half_angle`
            is 30 deg, the equilateral tooth of figures 3 to 5 of F. Sorge, "A note on the mechanics of ancient gear
            systems". If no clearance is given, `window` is 0.5, half-way between jamming and loss of contact
            (docs/teeth.md, section 5).

        Returns
        -------
        GearTrain
            New train with these teeth.

        Raises
        ------
        QuestionError
            If the form or a pair does not exist.
        DeclarationError
            If a parameter is unknown or has an invalid value.

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

        if not isinstance(form, str):
            return self.with_tooth_form("table", pairs, function=form, **parameters)
        known = tooth_forms()
        check_choice("tooth form", form, known)
        declared = {gear.name: gear for gear in self.declaration.gears}
        for pair in pairs:
            check_choice("gear pair", pair, declared)
        teeth = {"form": form, **known[form].with_defaults(parameters)}
        gears = []
        for gear in (declared[name] for name in pairs or declared):
            # forms of single pairs would override the form of the train, so they are deleted
            own = {"pair": list(gear.pair), "tooth_form": teeth if pairs else None}
            gears.append({"id": gear.id, **own} if gear.id else own)
        return self.with_changes({"gears": gears} if pairs else {"tooth_form": teeth, "gears": gears})

    @property
    def unfolded(self) -> GearTrain:
        """Train that declares each of several equal planets (`copies`) by itself; the same object if it has none."""
        # not cached if it is the train itself, which would be a reference cycle
        return self._unfolded if has_copies(self.declaration) else self

    @cached_property
    def _unfolded(self) -> GearTrain:
        return GearTrain(self.mechanics.unfolded.declaration)

    # ----------------------------------------------------------------------------------------------------------- parts

    @cached_property
    def kinematics(self) -> TrainKinematics:
        """Results that need no tooth forms: tree of turning pairs, inputs of states, gridlock, and sensitivities."""
        return TrainKinematics(self.declaration)

    @cached_property
    def mechanics(self) -> TrainMechanics:
        """Results that depend on tooth forms and loads: driving wheels of pairs, transmission errors, and torques."""
        from geartrain.dynamics.train_mechanics import TrainMechanics

        return TrainMechanics(self.kinematics)

    def __repr__(self) -> str:
        declared = self.declaration
        links, wheels = len(declared.links), len(declared.wheels)
        size = f"{links} links, {wheels} wheels" + (f", {len(self.states)} states" if self.states else "")
        try:
            verdicts = " or ".join(dict.fromkeys(answer.verdict.kind for answer in self.answers()))
        # repr must not raise, even for a declaration that cannot be solved
        except GearTrainError as error:
            verdicts = error.problems[0].what
        return f"<GearTrain {self.name}: {size}; {verdicts}>"

    def _repr_html_(self) -> str:
        page = imported_function("report.train_report", "describe_in_short")(self)
        try:
            text: str = imported_function("report.html_page", "to_fragment")([page])
        except MissingExtraError:
            text = f"<pre>{html.escape(str(page))}</pre>"
        try:
            picture: str = imported_function("drawing.train_pictures", "thumbnail")(self)
        except GearTrainError:  # without matplotlib, or for a train that cannot be drawn
            picture = ""
        return text + picture


def load(source: str | Path | Mapping[str, Any]) -> GearTrain:
    """Load a train from a YAML file, the name of a train shipped with geartrain, YAML text, or plain data.

    The circuits and the inputs, brakes and locks of all states are computed immediately, so that every error of the
    declaration is reported.

    Parameters
    ----------
    source : str, Path or mapping
        Path of a file, name of a shipped train (see `geartrain.shipped`), multi-line YAML text, or a declaration as
        plain data.

    Returns
    -------
    GearTrain
        Train with its circuits and the speeds and loads prescribed in its states. All other results are computed when
        they are first requested.

    Raises
    ------
    DeclarationError
        If the declaration is invalid. The message gives the location (`file:line`) and the fix of every error.

    Examples
    --------
    In a planetary gear set with 24, 18 and 60 teeth and a fixed ring, the carrier makes 24 / (24 + 60) revolutions per
    revolution of the sun:

    >>> train = load("planetary-24-18-60")
    >>> train.solve()["carrier"]
    Fraction(2, 7)
    """
    from geartrain.train.declaration_files import read_declaration

    train = GearTrain(read_declaration(source))
    _ = train.circuits, train.kinematics.cases
    return train
