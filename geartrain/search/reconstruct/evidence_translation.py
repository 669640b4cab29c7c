"""Conversion of declared evidence to a `ReconstructionProblem`. Unsupported declarations are rejected with a message
that gives their location.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from geartrain.errors import DeclarationError, Loc, Problem, first_problems
from geartrain.kinematics.judged_outputs import goal_of
from geartrain.numerics.results import Shown
from geartrain.search.reconstruct.link_roles import (
    BaseLink,
    Joined,
    base_problems,
    carrier_axis,
    coupling_problems,
    find_base,
    join_arbors,
    joined_arbors,
    parted_problems,
)
from geartrain.search.reconstruct.reconstruction_problem import (
    NEW,
    Additions,
    PriorFactors,
    ReconstructionProblem,
    SearchedDial,
    SurvivingArbor,
    SurvivingGeometry,
    SurvivingWheel,
    find_unreachable,
    magnitude_bounds,
    read_geometry_evidence,
    refuse_unreachable,
    unweighed_geometry,
)
from geartrain.train import Output, Teeth, Train, Wheel
from geartrain.train.reconstruction import NEW_ARBOR

# Range of the speed of a pointer, from all declarations of its output.


Limits = tuple[Fraction, Fraction]


def find_dial(evidence: Train, name: str, free_sense: bool, base: BaseLink) -> SearchedDial:
    """Return the dial of an output. The bounds of its speed are relative to the base, which is the link that carries
    the arbors. If `free_sense` is True, they are bounds of the magnitude of this speed.

    `DeclarationError` is raised if the admissible speeds do not form a single range.
    """
    output, place = evidence.outputs[name], evidence.place("outputs", name)
    if output.relative_to not in (None, evidence.frame, base.name):
        what = f"the speed of '{name}' is relative to '{output.relative_to}'"
        carrier = "" if base.name == evidence.frame else f" or the carrier '{base.name}'"
        why = f"a reconstruction supports only speeds relative to the frame{carrier}"
        raise DeclarationError(Problem(what, why, f"give its speed relative to the frame{carrier}", place))
    if output.of == evidence.frame:
        what, fix = f"the pointer '{name}' is on the frame", "name in `of` the link that carries the pointer"
        raise DeclarationError(Problem(what, "the frame does not turn", fix, place))
    (minimum, maximum), signed = _bounds(evidence, name, free_sense)
    turning = base.seen(output.relative_to or evidence.frame)
    if turning and not signed:
        what = f"the sense of '{name}' is not known, and its speed is relative to the frame"
        why = "the pointer would have two possible speeds relative to the carrier"
        raise DeclarationError(Problem(what, why, "give its sense, or its speed with `relative_to` the carrier", place))
    on = NEW if output.of == NEW_ARBOR else output.of
    dial = SearchedDial(name, minimum - turning, maximum - turning, signed, on)
    if output.of is None and base.source == evidence.frame and dial.accepts(base.driven):
        what = f"the speed of '{name}' may be the speed of the frame, so its pointer could be on the frame"
        fix = "name its arbor in `of`, or give `of: new` if its arbor is lost"
        raise DeclarationError(Problem(what, "the arbor of the pointer is not declared", fix, place))
    return dial


def _bounds(evidence: Train, name: str, free_sense: bool) -> tuple[Limits, bool]:
    """Return the minimum and the maximum declared speed of an output, and whether the sense of rotation is known. If it
    is not known, they are the minimum and the maximum of the magnitude of the speed.
    """
    output, place = evidence.outputs[name], evidence.place("outputs", name)
    known = list(_ranges(evidence, output))
    if not known:
        why = "the output has no `expect`, and no target with a tolerance"
        fix = "for example, add `expect: -5/19`, or add `tolerance: 1/446` to a target"
        raise DeclarationError(Problem(f"the speed of '{name}' is not known", why, fix, place))
    signed = [limits for limits, has_sign in known if has_sign and not free_sense]
    plain = [
        magnitude_bounds(*limits) if has_sign else limits for limits, has_sign in known if not has_sign or free_sense
    ]
    if not signed:
        return _common(plain, name, place), False
    limits = _common(signed, name, place)
    if plain:
        low, high = _common(plain, name, place)
        # a magnitude above 0 allows one interval in each sense
        senses = [(low, high), (-high, -low)] if low > 0 else [(-high, high)]
        allowed = [each for each in senses if each[0] <= limits[1] and limits[0] <= each[1]]
        if len(allowed) > 1:
            what = f"the possible speeds of '{name}' are two intervals"
            why = "the targets with a sense allow both senses, and the target of the magnitude excludes speeds near 0"
            raise DeclarationError(Problem(what, why, "keep only one of the targets", place))
        limits = _common([limits, *(allowed or senses)], name, place)
    return limits, True


def _ranges(evidence: Train, output: Output) -> Iterator[tuple[Limits, bool]]:
    """Yield each declared range of the speed of an output, and True for a range of the signed speed or False for a
    range of its magnitude.
    """
    if output.expect is not None:
        value, tolerance = output.expect.value, output.expect.tolerance
        half = tolerance.value if tolerance is not None else value.half or Fraction(0)
        yield (value.value - half, value.value + half), True
    for target in output.targets:
        goal = goal_of(evidence, target)
        if target.tolerance is not None:
            # absolute tolerance if the speed is 0
            half = target.tolerance.base * (abs(goal.speed) or 1)
        elif target.speed is not None and output.expect is None:
            half = (target.speed.half or Fraction(0)) * target.turns.value
        else:
            continue
        yield (goal.speed - half, goal.speed + half), goal.signed


def _common(ranges: list[Limits], name: str, place: str) -> Limits:
    """Return the intersection of ranges of the speed of an output."""
    minimum, maximum = max(low for low, _ in ranges), min(high for _, high in ranges)
    if minimum > maximum:
        what = f"the declared speeds of '{name}' contradict each other"
        why = "no speed is within `expect` and all targets with a tolerance"
        raise DeclarationError(Problem(what, why, "correct `expect` or a target", place))
    return minimum, maximum


_UNSUPPORTED = ("fixed", "locks", "clutches", "states", "loads", "solve_for", "drive", "escapement")
"""Keys of a train declaration that are not supported in a reconstruction, because they change speeds or refer to
arbors.
"""

_MOST_COUNTS = 10_000
"""Maximum number of possible tooth counts of one wheel."""


@dataclass(frozen=True)
class EvidenceQuestion(Shown):
    """Reconstruction problem derived from declared evidence, with its base link and the declarations that are not used.

    See Also
    --------
    evidence_question : Convert declared evidence to a problem.
    """

    problem: ReconstructionProblem
    """Reconstruction problem, the input of the search."""
    base: BaseLink
    """Base link, which carries the arbors. The speeds in the problem are relative to this link."""
    joined: Joined
    """Links that form one arbor because declared couplings connect them, keyed by the name of the arbor."""
    unused: tuple[str, ...]
    """Descriptions of the declarations that do not affect the result, one line for each."""


def evidence_question(evidence: Train, wheels: int | None = None, idlers: bool = False) -> EvidenceQuestion:
    """Convert declared evidence to a reconstruction problem.

    Parameters
    ----------
    evidence : Train
        Declaration with `reconstruct`.
    wheels : int, optional
        Maximum number of added wheels; it overrides the number in the evidence.
    idlers : bool
        True to allow that a driven wheel also drives, even if the evidence does not allow it.

    Returns
    -------
    EvidenceQuestion

    Raises
    ------
    DeclarationError
        If declarations are unsupported or do not define a problem. The message gives the location of each such
        declaration.

    Examples
    --------
    >>> from geartrain.search.reconstruct import read_evidence
    >>> requested = evidence_question(read_evidence("metonic-l-m")).problem
    >>> [arbor.name for arbor in requested.arbors], requested.additions.wheels
    (['l', 'm'], 1)
    """
    requested = evidence.reconstruct
    assert requested is not None, "no evidence"
    found = [*_unsupported(evidence), *coupling_problems(evidence), *_wheels(evidence)]
    unclear = list(base_problems(evidence))
    base = None if unclear else find_base(evidence)
    found += unclear
    if wheels and requested.add.teeth is None:
        fix = "for example, declare `add: {teeth: [12, 225]}`"
        place = evidence.place("reconstruct")
        why = "the search needs the minimum and maximum count of an added wheel"
        found.append(Problem("the tooth counts of added wheels have no limits", why, fix, place))
    dials = []
    for name in evidence.outputs:
        try:
            if base is not None:
                dials.append(find_dial(evidence, name, requested.sense == "free", base))
        except DeclarationError as error:
            found += error.problems
    if not evidence.outputs:
        fix = "add `outputs:`, each with `expect` or a target with its tolerance"
        found.append(Problem("the evidence has no outputs", "a reconstruction explains the speeds of pointers", fix))
    if found or base is None:
        raise DeclarationError(first_problems(found))
    others = (link for link in evidence.links if link not in (base.source, base.name, evidence.frame))
    arbors = tuple(_arbor(evidence, link) for link in others)
    geometry = read_geometry_evidence(evidence)
    unreachable = frozenset(find_unreachable((_arbor(evidence, base.source), *arbors), geometry))
    refuse_unreachable(evidence, unreachable)
    limits = requested.add
    minimum, maximum = limits.teeth or (1, 1)  # the limits do not matter if nothing is added
    problem = ReconstructionProblem(
        input=_arbor(evidence, base.source),
        arbors=arbors,
        dials=tuple(dials),
        additions=Additions(limits.wheels if wheels is None else wheels, minimum, maximum, limits.arbors, limits.on),
        input_speed=base.driven,
        meshes=frozenset(frozenset(gear.pair) for gear in evidence.gears),
        apart=frozenset(frozenset(pair) for pair in requested.apart) | unreachable,
        coaxial=frozenset(_coaxial(evidence, base, geometry)),
        use=requested.use,
        idlers=requested.idlers or idlers,
        factors=PriorFactors(requested.cost.wheel.value, requested.cost.arbor.value, requested.cost.unused.value),
        geometry=geometry,
    )
    joined = joined_arbors(evidence)
    if parted := list(parted_problems(evidence, problem, joined)):
        raise DeclarationError(first_problems(parted))
    return EvidenceQuestion(join_arbors(problem, joined), base, joined, tuple(_unused(evidence)))


def _arbor(evidence: Train, link: str) -> SurvivingArbor:
    # the frame need not be listed among the links
    wheels = evidence.links[link].wheels if link in evidence.links else {}
    return SurvivingArbor(
        link, tuple(SurvivingWheel(name, _counts(wheel), wheel.internal) for name, wheel in wheels.items())
    )


def _coaxial(evidence: Train, base: BaseLink, geometry: SurvivingGeometry) -> Iterator[frozenset[str]]:
    """Yield pairs of arbors that are declared on the same axis, or on axes with equal positions."""
    on_axis: dict[str, set[str]] = {}
    for joint in evidence.revolutes:
        on_axis.setdefault(joint.axis, set()).update(joint.pair)
    if base.name != evidence.frame:
        on_axis.setdefault(carrier_axis(evidence, base.name) or "", set()).add(base.source)
    for links in on_axis.values():
        # the base is on no axis; on a carrier the frame is the first arbor of the train
        links -= {base.name, evidence.frame} - {base.source}
        yield from map(frozenset, combinations(sorted(links), 2))
    for one, other in combinations(geometry.arbors, 2):
        if one.place == other.place:
            yield frozenset((one.name, other.name))


def _counts(wheel: Wheel) -> tuple[tuple[int, Fraction], ...]:
    """Return pairs of a possible tooth count of a wheel and its weight. The sum of the weights is 1."""
    teeth = wheel.teeth
    if isinstance(teeth, int):
        return ((teeth, Fraction(1)),)
    probabilities = teeth.probabilities
    if not probabilities:
        assert teeth.value is not None
        return ((teeth.value, Fraction(1)),)
    return tuple(probabilities.items())


# declarations that are not supported


def _unsupported(evidence: Train) -> Iterator[Problem]:
    unsupported: list[tuple[str, Loc]] = [(f"`{key}` is", (key,)) for key in _UNSUPPORTED if getattr(evidence, key)]
    if evidence.crank is not None and evidence.crank not in evidence.inputs:
        unsupported.append(("a crank that is not the input is", ("crank",)))
    for label, axis in evidence.axes.items():
        if any(figure.value for figure in axis.direction[:2]) or axis.direction[2].value < 0:
            unsupported.append(("axes that are not parallel are", ("axes", label)))
    for what, loc in unsupported:
        yield _unsupported_problem(evidence, f"{what} not supported in a reconstruction", *loc)


def _unsupported_problem(evidence: Train, what: str, *loc: str | int) -> Problem:
    why = "ignoring it could change the trains that are found"
    return Problem(what, why, "remove the declaration from the evidence", evidence.place(*loc))


def _wheels(evidence: Train) -> Iterator[Problem]:
    for name, (link, wheel) in evidence.wheels.items():
        loc, teeth = ("links", link, "wheels", name), wheel.teeth
        if wheel.kind != "spur":
            what = f"'{name}' is a {wheel.kind} wheel, which is not supported in a reconstruction"
            yield _unsupported_problem(evidence, what, *loc)
        if not isinstance(teeth, Teeth):
            continue
        for count in (teeth.range[1] - teeth.range[0] + 1 if teeth.range else 0, len(teeth.searched)):
            if count > _MOST_COUNTS:
                what = f"wheel '{name}' has {count} possible tooth counts"
                why = f"at most {_MOST_COUNTS} tooth counts per wheel can be searched"
                yield Problem(what, why, "narrow the range of tooth counts", evidence.place(*loc, "teeth"))
        if fault := teeth.fault_of_weights:
            what = f"the weights of the tooth counts of wheel '{name}' do not define probabilities"
            fix = "give non-negative weights, at least one of them above 0"
            yield Problem(what, fault, fix, evidence.place(*loc, "teeth", "weights"))


def _unused(evidence: Train) -> Iterator[str]:
    """Yield a one-line description of each declaration that the search does not use."""
    yield from unweighed_geometry(evidence)
    for gear in evidence.gears:
        if gear.driver is not None:
            yield f"the driver of '{gear.name}': either wheel may drive"
    for name, output in evidence.outputs.items():
        for target in output.targets:
            if target.tolerance is None and (target.speed is None or output.expect is not None):
                yield f"a target of '{name}' ({target.name or target.period or target.speed}): it has no tolerance"
        if output.published is not None:
            yield f"`published` of '{name}': only `expect` and targets with a tolerance are used"
