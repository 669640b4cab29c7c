"""The first half of a train that answers: from its declaration to circuits, mobility and speeds."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property, wraps
from typing import TYPE_CHECKING, Any, Self, TypeVar, cast

from geartrain.errors import DeclarationError, Problem, QuestionError, suggest
from geartrain.kinematics.answer import Answer
from geartrain.kinematics.circuits import Axes, Circuit, Tree, close_joints, find_circuits, find_tree
from geartrain.kinematics.planet_copies import as_one, check_copies, has_copies, with_copies
from geartrain.kinematics.speed_problem import Method, SpeedProblem
from geartrain.kinematics.speeds import Mobility, find_mobility
from geartrain.kinematics.tooth_sensitivity import Sensitivity
from geartrain.kinematics.willis_system import WillisSystem
from geartrain.train import StateCase, Train

if TYPE_CHECKING:
    from geartrain.kinematics.formulas.speed_formulas import OutputFormula
    from geartrain.kinematics.gridlock import Gridlock
    from geartrain.kinematics.speeds import FloatSpeeds

_Question = TypeVar("_Question", bound=Callable[..., Any])


def _asked_of(other: Callable[[TrainKinematics], TrainKinematics], question: _Question) -> _Question:
    @wraps(question)
    def asked(train: TrainKinematics, *args: Any, **given: Any) -> Any:
        return question(other(train), *args, **given)

    return cast("_Question", asked)


def of_planets_as_one(question: _Question) -> _Question:
    """A question that is asked of the train with one planet as heavy and stiff as all that are equal."""
    return _asked_of(lambda train: train.planets_as_one, question)


def of_all_planets(question: _Question) -> _Question:
    """A question that is asked of the train with each of its equal planets: loads are shared among them."""
    return _asked_of(lambda train: train.unfolded, question)


class TrainKinematics:
    """What `GearTrain` knows without teeth: how everything turns. Parts are made once, when first asked for."""

    def __init__(self, declaration: Train) -> None:
        self.declaration = declaration

    @property
    def name(self) -> str:
        """The declared name."""
        return self.declaration.name

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the declared states; empty for a train that has only one way to run."""
        return tuple(self.declaration.states)

    def state_or_first(self, state: str | None) -> str | None:
        """A state that was named, else the first declared; None for a train that has none.

        Parameters
        ----------
        state : str or None
            A declared state, or None.
        """
        return state if state is not None or not self.states else self.states[0]

    @cached_property
    def tree(self) -> Tree:
        """The turning pairs as a spanning tree rooted at the frame."""
        tree = find_tree(self.declaration)
        if self._has_copies:
            check_copies(self.declaration, tree)
        return tree

    @cached_property
    def _has_copies(self) -> bool:
        return has_copies(self.declaration)

    @property
    def unfolded(self) -> Self:
        """The train with each of its equal planets declared; itself where no link stands for several (`copies`)."""
        # not kept where it is the train itself: that would hold itself
        return self._with_copies if self._has_copies else self

    @cached_property
    def _with_copies(self) -> Self:
        return type(self)(with_copies(self.declaration, self.tree))

    @property
    def planets_as_one(self) -> Self:
        """The train in which one planet is as heavy and as stiff as all its copies; itself where there are none."""
        return self._as_one if self._has_copies else self

    @cached_property
    def _as_one(self) -> Self:
        return type(self)(as_one(self.declaration))

    @cached_property
    def circuits(self) -> tuple[Circuit, ...]:
        """One fundamental circuit for each gear pair and coupling."""
        return find_circuits(self.declaration, self.tree)

    @cached_property
    def cases(self) -> Mapping[str | None, StateCase]:
        """What is prescribed in each state, or once for None, with rigid connections joint by joint."""
        declared = self.declaration.cases
        return {case.state: case for case in close_joints(self.declaration, self.tree, declared)}

    @property
    def usable_states(self) -> tuple[str | None, ...]:
        """States in which speeds can be calculated; None for a train without states."""
        return tuple(state for state, case in self.cases.items() if not case.problems)

    @cached_property
    def _axes(self) -> Axes:
        return Axes(self.declaration, self.tree)

    @cached_property
    def signs(self) -> Mapping[str, int]:
        """-1 for links whose axis points against the reference direction of its parallels."""
        return self._axes.link_signs

    @cached_property
    def bookkeeping(self) -> frozenset[str]:
        """Links whose speed is a sum over non-parallel joints, and no rotation."""
        return self._axes.joint_sums

    def is_rotation(self, of: str, base: str) -> bool:
        """True if the axes between two links are parallel: the speed of one seen from the other is then a rotation.

        Parameters
        ----------
        of, base : str
            Two links; the order does not matter.
        """
        return not self.bookkeeping or self._axes.is_rotation(of, base)

    @cached_property
    def _speeds(self) -> SpeedProblem:
        # not the method of the train: the train would hold itself, and a large one would wait for the garbage collector
        is_rotation = self._axes.is_rotation if self.bookkeeping else _always
        return SpeedProblem(self.declaration, self.circuits, self.signs, is_rotation)

    @cached_property
    def mobility(self) -> Mobility:
        """Degrees of freedom by count and by exact rank, with redundant and locking loops (docs/theory.md, 6)."""
        return find_mobility(self._speeds.whole.reduced, len(self.declaration.revolutes))

    @cached_property
    def is_placed(self) -> bool:
        """True if it can be asked whether teeth meet: axes have positions or directions, and pairs close loops."""
        return self.declaration.has_placed_axes and bool(self.mobility.redundant or self.mobility.locked)

    @cached_property
    def gridlock(self) -> Gridlock:
        """Why meshes lock the train or a part of it, and the least set of them to disengage; cheap where none does."""
        from geartrain.kinematics.gridlock import find_gridlock

        return find_gridlock(self._speeds.whole, self.mobility)

    @cached_property
    def remarks(self) -> tuple[Problem, ...]:
        """Conventions that the answers of a sound declaration rest on: notes, never errors."""
        from geartrain.kinematics.lint import lint_train

        return tuple(lint_train(self.declaration, self.circuits))

    def equations(self, state: str | None = None) -> WillisSystem:
        """The labelled Willis system of one state (docs/theory.md, 6).

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        """
        return self._speeds.equations(self._case(state))

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
            float64 and tells residuals, condition numbers and errors; "floats" is its older name. Speeds in radians
            beside others in turns are rounded to floats in any case.

        Returns
        -------
        Answer
            Speeds by link, outputs judged against what is expected and wanted, and the verdict: a train that is locked
            or free is no error.

        Raises
        ------
        QuestionError
            For a state, an output or a method that there is not.
        """
        return self._speeds.answer(self.cases[self.declaration.single_state(state)], output, method)

    def formula(self, output: str, state: str | None = None) -> OutputFormula:
        """What an output is, in the tooth counts of the wheels and the speeds of the inputs.

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
            For an output or a state that there is not, or where the inputs do not determine the output.

        Examples
        --------
        >>> import geartrain
        >>> train = geartrain.load("planetary-24-18-60")
        >>> train.formula("carrier").text
        'carrier = z_s/(z_s + z_ring) · sun'
        """
        found = tuple(self.formulas(state, (output,)))
        if not found:
            what, why = f"output '{output}' has no formula", "the inputs do not determine it"
            raise QuestionError(Problem(what, why, "see `geartrain check` for what is missing"))
        return found[0]

    def formulas(self, state: str | None = None, outputs: Sequence[str] = ()) -> Iterator[OutputFormula]:
        """The formulas of all outputs of a state that the inputs determine, or of some.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        outputs : sequence of str
            Some of them; by default all.
        """
        from geartrain.kinematics.formulas.speed_formulas import speed_formulas

        return speed_formulas(self.declaration, self.declaration.single_state(state), outputs)

    def answers(self) -> Iterator[Answer]:
        """The answer of every state, in the order declared."""
        return (self.solve(state) for state in (self.states or (None,)))

    def sensitivity(self, answer: Answer) -> Iterator[Sensitivity]:
        """What one tooth fewer or more on each uncertain wheel does to each output of an answer.

        Parameters
        ----------
        answer : Answer
            As `solve` gives it.
        """
        return self._speeds.sensitivity(self._case(answer.state), answer)

    def floats(
        self,
        state: str | None = None,
        inputs: Mapping[str, Sequence[float]] | None = None,
        condition_of: Sequence[str] = (),
    ) -> FloatSpeeds:
        """Float64 speeds through a sparse LU, with error estimates; many input speeds share one factorisation.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        inputs : mapping of str to sequence of float, optional
            Link -> speeds, one a case, in place of the declared ones [unit of the train].
        condition_of : sequence of str
            Links whose component-wise condition number is wanted (docs/theory.md, equation 25).

        Returns
        -------
        FloatSpeeds
            Speeds and error estimates, arrays (link, case).
        """
        return self._speeds.floats(self._case(state), inputs, condition_of)

    def _circuits_without(self, names: Sequence[str]) -> tuple[Circuit, ...]:
        known = [circuit.id for circuit in self.circuits]
        for name in (name for name in names if name not in known):
            what = f"'{self.name}' has no pair '{name}'"
            raise QuestionError(Problem(what, "it is not declared", suggest(name, known)))
        return tuple(circuit for circuit in self.circuits if circuit.id not in names)

    def _case(self, state: str | None) -> StateCase:
        case = self.cases[self.declaration.single_state(state)]
        if case.problems:
            raise DeclarationError(case.problems)
        return case

    def _repr_html_(self) -> str:
        declared = self.declaration
        title = f"<p><b>{html.escape(declared.name)}</b> {html.escape(declared.title)}</p>"
        return title + "".join(answer._repr_html_() for answer in self.answers())


def _always(of: str, base: str) -> bool:
    """All speeds are rotations, whichever two links are seen from each other."""
    del of, base
    return True
