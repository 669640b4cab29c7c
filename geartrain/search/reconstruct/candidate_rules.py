"""Rules of a question applied to one candidate: those it breaks, and the question that would admit it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce
from typing import Literal

from geartrain.numerics.exact import fraction_text
from geartrain.numerics.results import Result
from geartrain.search.reconstruct.arbor_orders import may_mesh
from geartrain.search.reconstruct.geometry_likelihood import candidate_likelihood
from geartrain.search.reconstruct.reconstruction_problem import (
    NEW,
    Arbor,
    ReconstructionProblem,
    SearchedDial,
    SurvivingArbor,
    SurvivingWheel,
    find_unreachable,
)

Rule = Literal[
    "dial", "speed", "place", "wheel", "arbor", "count", "driven", "idler", "end", "ring", "teeth", "arbors", "beside",
    "seen", "apart", "coaxial", "distance",
]  # fmt: skip
"""What a rule is about.

dial      every dial is shown
speed     with its speed and sense
place     on the arbor where it is
wheel     every surviving wheel meshes
arbor     every surviving arbor is in the train
count     a surviving wheel has a count that was read
driven    a surviving wheel of a surviving arbor is driven
idler     a driven wheel drives nothing
end       an arbor that drives nothing shows a dial
ring      a ring meshes with wheels of fewer teeth alone
teeth     added wheels have as many teeth as they may
arbors    there are no more added arbors than there may be
beside    wheels are added on new arbors alone
seen      wheels that were seen in mesh do
apart     wheels that do not mesh do not
coaxial   arbors on one axis do not mesh
distance  wheels in mesh reach from axis to axis
"""


@dataclass(frozen=True, slots=True)
class BrokenRule(Result):
    """A rule that a candidate breaks.

    Attributes
    ----------
    rule : str
        What the rule is about.
    subject : tuple of str
        Names of the dial, wheels or arbors; none where it is about what is added.
    what : str
        What the candidate has.
    change : str or None
        What would have to be otherwise in the evidence to take it; None where nothing single would.
    values : tuple of Fraction
        The speed or the count that it has, or bounds that would hold what is added.
    """

    KEYS = ("rule", "subject", "what", "change")

    rule: Rule
    subject: tuple[str, ...]
    what: str
    change: str | None
    values: tuple[Fraction, ...] = ()


def broken_rules(candidate: Arbor, problem: ReconstructionProblem) -> tuple[BrokenRule, ...]:
    """Every rule that a candidate breaks but for the number of added wheels; none just where it explains the dials.

    Parameters
    ----------
    candidate : Arbor
        From its input on. Its surviving arbors and wheels have the names of the question's, and it shows no other
        dials.
    problem : ReconstructionProblem
    """
    return (
        *_of_dials(candidate, problem),
        *_of_use(candidate, problem),
        *_of_arbors(candidate, problem),
        *_of_additions(candidate, problem),
        *_of_meshes(candidate, problem),
    )


def _of_dials(candidate: Arbor, problem: ReconstructionProblem) -> Iterator[BrokenRule]:
    shown: dict[str, list[tuple[Arbor, Fraction]]] = {}
    for arbor, speed in _speeds(candidate, problem.input_speed, problem.rings):
        for name in arbor.dials:
            shown.setdefault(name, []).append((arbor, speed))
    for dial in problem.dials:
        if len(shown.get(dial.name, ())) != 1:
            yield BrokenRule("dial", (dial.name,), f"{dial.name} is not shown", _without(dial.name))
            continue
        ((arbor, speed),) = shown[dial.name]
        if not dial.least <= (speed if dial.signed else abs(speed)) <= dial.greatest:
            turns = fraction_text(speed)
            what = f"{dial.name} turns at {turns}, not {speed_text(dial)}"
            yield BrokenRule("speed", (dial.name,), what, f"if {dial.name} turns at {turns}", (speed,))
        if dial.place not in (None, arbor.name or NEW):
            at = "an added arbor" if arbor.name is None else arbor.name
            where = "is lost" if dial.place == NEW else f"is {dial.place}"
            change = f"without the fact that the arbor of {dial.name} {where}"
            yield BrokenRule("place", (dial.name,), f"{dial.name} is shown on {at}", change)


def as_missing_dial(broken: BrokenRule) -> BrokenRule:
    """A dial of another speed as one that is not shown; else the same."""
    if broken.rule != "speed":
        return broken
    return replace(broken, rule="dial", change=_without(*broken.subject), values=())


def _without(dial: str) -> str:
    return f"without the dial {dial}"


def speed_text(dial: SearchedDial) -> str:
    """The speed that a dial must have, in words."""
    bounds = dict.fromkeys((dial.least, dial.greatest))
    text = " to ".join(fraction_text(each) if dial.is_exact else f"{float(each):.7g}" for each in bounds)
    return text + ("" if dial.signed else " in either sense")


def _speeds(candidate: Arbor, speed: Fraction, rings: frozenset[str]) -> Iterator[tuple[Arbor, Fraction]]:
    """Every arbor with its speed."""
    yield candidate, speed
    for wheel, child in candidate.driven_arbors():
        assert child.driven is not None
        sense = 1 if {wheel.name, child.driven.name} & rings else -1
        yield from _speeds(child, sense * speed * wheel.teeth / child.driven.teeth, rings)


def _of_use(candidate: Arbor, problem: ReconstructionProblem) -> Iterator[BrokenRule]:
    used = {wheel.name: wheel.teeth for wheel in candidate.wheels() if wheel.name is not None}
    here = {arbor.name for arbor in candidate.arbors()}
    for arbor in (problem.input, *problem.arbors):
        if arbor.name not in here and (problem.use == "arbors" or (problem.use == "wheels" and arbor.wheels)):
            yield BrokenRule("arbor", (arbor.name,), f"{arbor.name} is not in the train", f"without {arbor.name}")
            continue
        for wheel in arbor.wheels:
            if wheel.name not in used:
                if problem.use == "wheels":
                    yield BrokenRule("wheel", (wheel.name,), f"{wheel.name} is not used", f"without {wheel.name}")
            elif used[wheel.name] not in {count for count, _ in wheel.counts}:
                teeth = used[wheel.name]
                what = f"{wheel.name} has {teeth} teeth, not {counts_text(wheel.counts)}"
                change = f"if {wheel.name} has {teeth} teeth"
                yield BrokenRule("count", (wheel.name,), what, change, (Fraction(teeth),))


def counts_text(counts: Sequence[tuple[int, Fraction]]) -> str:
    """Counts that a wheel may have, in few words."""
    teeth = [count for count, _ in counts]
    if len(teeth) > 1 and teeth == list(range(teeth[0], teeth[-1] + 1)):
        return f"{teeth[0]}-{teeth[-1]}"
    return "/".join(map(str, teeth))


def _of_arbors(candidate: Arbor, problem: ReconstructionProblem) -> Iterator[BrokenRule]:
    wheels = {arbor.name: arbor.wheels for arbor in problem.arbors}
    for arbor in candidate.arbors():
        said = arbor.name or "an added arbor"
        if arbor.name in wheels and wheels[arbor.name] and arbor.driven and arbor.driven.name is None:
            what = f"{said} is driven by a wheel of {arbor.driven.teeth} that is added to it"
            yield BrokenRule("driven", (said,), what, f"if {said} is lost")
        if arbor.passes and not problem.idlers:
            assert arbor.driven is not None
            idler = arbor.driven.name or f"an added wheel of {arbor.driven.teeth}"
            yield BrokenRule("idler", (said,), f"{idler} is driven, and drives", "if a driven wheel may drive")
        if not arbor.dials and not any(arbor.driven_arbors()):
            yield BrokenRule("end", (said,), f"{said} leads to no pointer", None)


def _of_additions(candidate: Arbor, problem: ReconstructionProblem) -> Iterator[BrokenRule]:
    limits = problem.additions
    added = sorted({wheel.teeth for wheel in candidate.wheels() if wheel.name is None})
    beyond = [teeth for teeth in added if not limits.least <= teeth <= limits.greatest]
    if beyond:
        least, greatest = min(limits.least, *added), max(limits.greatest, *added)
        bounds = Fraction(least), Fraction(greatest)
        what = f"added wheels have {', '.join(map(str, beyond))} teeth, and {limits.least} to {limits.greatest} may be"
        yield BrokenRule("teeth", (), what, f"if added wheels may have {least} to {greatest} teeth", bounds)
    arbors = candidate.added_arbors
    if limits.arbors is not None and arbors > limits.arbors:
        what = f"arbors are added: {arbors}, and {limits.arbors} may be"
        yield BrokenRule("arbors", (), what, f"if {arbors} arbors may be added", (Fraction(arbors),))
    beside = [arbor.name for arbor in candidate.arbors() if arbor.name and None in _own_wheels(arbor)]
    if limits.on == "new" and beside:
        what = f"wheels are added on {', '.join(beside)}"
        yield BrokenRule("beside", (), what, "if wheels may be added on surviving arbors")


def _own_wheels(arbor: Arbor) -> set[str | None]:
    """Names of wheels of one arbor that mesh, None for added ones."""
    driven = set() if arbor.driven is None else {arbor.driven.name}
    return driven | {wheel.name for wheel, _ in arbor.drives}


def _of_meshes(candidate: Arbor, problem: ReconstructionProblem) -> Iterator[BrokenRule]:
    meshes = list(candidate.meshes())
    wheels = {_pair(wheel.name, child.driven.name) for _, wheel, child in meshes if child.driven}
    arbors = {_pair(parent.name, child.name) for parent, _, child in meshes}
    for pair in sorted(map(sorted, problem.meshes - wheels)):
        said = " and ".join(pair)
        yield BrokenRule("seen", tuple(pair), f"{said} do not mesh", f"without the fact that {said} mesh")
    for pair in sorted(map(sorted, problem.apart & wheels)):
        said = " and ".join(pair)
        yield BrokenRule("apart", tuple(pair), f"{said} mesh", f"without the fact that {said} do not mesh")
    for pair in sorted(map(sorted, problem.coaxial & arbors)):
        said = " and ".join(pair)
        what = f"wheels of {said} mesh, which are on one axis"
        yield BrokenRule("coaxial", tuple(pair), what, f"without the fact that {said} are coaxial")
    for _, wheel, child in meshes:
        if child.driven is not None and not may_mesh(wheel, child.driven, problem.rings):
            what = f"{wheel.name or wheel.teeth} does not turn in {child.driven.name or child.driven.teeth}"
            yield BrokenRule("ring", (), what, None)
    if problem.geometry.reach is not None and not candidate_likelihood(candidate, problem.geometry):
        what = "wheels in mesh do not reach from axis to axis"
        yield BrokenRule("distance", (), what, "if the distances of axes keep no wheels apart")


def _pair(one: str | None, other: str | None) -> frozenset[str | None]:
    return frozenset((one, other))


# The question that would take a candidate: with each rule that it breaks taken back.


def admitting_question(problem: ReconstructionProblem, broken: Iterable[BrokenRule]) -> ReconstructionProblem:
    """The question with all that candidates break taken back, as `change` of each says."""
    return reduce(_admit, broken, problem)


def _admit(problem: ReconstructionProblem, broken: BrokenRule) -> ReconstructionProblem:
    rule = broken.rule
    if rule in ("dial", "speed", "place"):
        dials = (_admitted_dial(dial, broken) if dial.name in broken.subject else dial for dial in problem.dials)
        return replace(problem, dials=tuple(dial for dial in dials if dial is not None))
    if rule in ("wheel", "arbor", "count", "driven"):
        return _without_parts(problem, broken)
    limits = problem.additions
    if rule == "teeth":
        least, greatest = map(int, broken.values)
        return replace(problem, additions=replace(limits, least=least, greatest=greatest))
    if rule == "arbors":
        return replace(problem, additions=replace(limits, arbors=int(broken.values[0])))
    if rule == "beside":
        return replace(problem, additions=replace(limits, on="any"))
    if rule == "idler":
        return replace(problem, idlers=True)
    return _without_pair(problem, broken)


def _without_pair(problem: ReconstructionProblem, broken: BrokenRule) -> ReconstructionProblem:
    """Without what is known of a pair, or of all distances; the same where the rule takes nothing back."""
    pair = frozenset(broken.subject)
    if broken.rule == "seen":
        return replace(problem, meshes=problem.meshes - {pair})
    if broken.rule == "apart":
        return replace(problem, apart=problem.apart - {pair})
    if broken.rule == "coaxial":
        return replace(problem, coaxial=problem.coaxial - {pair})
    if broken.rule == "distance":
        measured = frozenset(find_unreachable((problem.input, *problem.arbors), problem.geometry))
        return replace(problem, apart=problem.apart - measured, geometry=replace(problem.geometry, reach=None))
    return problem


def _admitted_dial(dial: SearchedDial, broken: BrokenRule) -> SearchedDial | None:
    if broken.rule == "dial":
        return None
    if broken.rule == "place":
        return replace(dial, place=None)
    (speed,) = broken.values
    return replace(dial, least=speed, greatest=speed, signed=True)


def _without_parts(problem: ReconstructionProblem, broken: BrokenRule) -> ReconstructionProblem:
    """Without a wheel or an arbor, or with a count read otherwise."""
    (name,) = broken.subject

    def changed(arbor: SurvivingArbor) -> SurvivingArbor:
        if broken.rule == "count":
            wheels = tuple(_read(wheel, broken) if wheel.name == name else wheel for wheel in arbor.wheels)
        else:
            wheels = tuple(wheel for wheel in arbor.wheels if wheel.name != name)
        return replace(arbor, wheels=wheels)

    gone = {arbor.name for arbor in problem.arbors if arbor.name == name and broken.rule in ("arbor", "driven")}
    arbors = tuple(changed(arbor) for arbor in problem.arbors if arbor.name not in gone)
    dials = tuple(replace(dial, place=NEW) if dial.place in gone else dial for dial in problem.dials)
    left = {wheel.name for arbor in (problem.input, *arbors) for wheel in arbor.wheels}
    names = {arbor.name for arbor in (problem.input, *arbors)}
    return replace(
        problem,
        input=changed(problem.input),
        arbors=arbors,
        dials=dials,
        meshes=frozenset(pair for pair in problem.meshes if pair <= left),
        apart=frozenset(pair for pair in problem.apart if pair <= left),
        coaxial=frozenset(pair for pair in problem.coaxial if pair <= names),
    )


def _read(wheel: SurvivingWheel, broken: BrokenRule) -> SurvivingWheel:
    (teeth,) = broken.values
    return replace(wheel, counts=((int(teeth), Fraction(1)),))
