"""Evidence from a complete train of which some arbors are taken as lost: a test of what evidence is worth."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from geartrain.errors import Problem, QuestionError, suggest
from geartrain.search.reconstruct.reconstruction_problem import Arbor
from geartrain.search.reconstruct.reconstruction_search import Reconstructions, mechanism
from geartrain.search.reconstruct.spur_tree import SpurTree, why_not
from geartrain.train import Train, declare
from geartrain.train.reconstruction import NEW_ARBOR

_KEPT = ("title", "sources", "unit", "view")
_OF_WHEELS = ("internal", "status", "source", "note")


def lost_evidence(tree: SpurTree, lost: Sequence[str], seen: bool = False) -> Train:
    """Evidence of a tree of which some arbors are lost.

    What survives are the other arbors with the wheels that mesh in the train, counts as they are used there, and the
    couplings of two of them; every pointer with its speed, on its arbor or on one that does not survive. As many wheels
    may be added as are lost, with as many teeth as any wheel of the part has; of a later part, as any of all parts.

    lost   links; `QuestionError` for the first arbor, and for what is no arbor of the tree, or has a ring
    seen   the meshes of wheels that survive were seen, and no more arbors may be added than are lost; else it is not
           known who meshes with whom
    """
    return declare(lost_evidence_data(tree, lost, seen))


def lost_evidence_data(tree: SpurTree, lost: Sequence[str], seen: bool = False) -> dict[str, Any]:
    """The same with the keys of a declaration."""
    _check(tree, lost)
    train = tree.train
    arbors = lost_arbors(tree, lost)
    given = train.model_dump(mode="json", exclude_unset=True, by_alias=True)
    words = "-".join(lost).replace(" ", "-")
    kept = {key: given[key] for key in _KEPT if given.get(key)}
    if "title" in kept:
        kept["title"] += f", without {', '.join(lost)}"
    surviving = [arbor for arbor in tree.arbors if arbor not in arbors]
    standing = {link for arbor in surviving for link in tree.links_of(arbor)}
    links: dict[str, Any] = {train.frame: {}, **({tree.base.name: {}} if tree.base.is_carrier else {})}
    for link in train.links:
        if link in standing:
            own = train.frame if link in train.fixed else link
            links[own] = {"wheels": {**links.get(own, {}).get("wheels", {}), **_wheels(tree, given, link)}}
    meshes = tree.meshes(arbors) if seen else ()
    return {
        "name": f"{train.name}-without-{words}",
        **kept,
        "frame": train.frame,
        "links": {link: one if one.get("wheels") else {} for link, one in links.items()},
        **({"gears": [{"pair": list(pair)} for pair in meshes]} if meshes else {}),
        "inputs": _inputs(tree, given),
        "outputs": {
            name: {"of": NEW_ARBOR if arbor in arbors else tree.link_of(name)} | _shown(tree, given, name)
            for name, arbor in tree.pointers.items()
        },
        "reconstruct": _asked(tree, arbors, seen),
    }


def lost_arbors(tree: SpurTree, links: Sequence[str]) -> tuple[str, ...]:
    """The arbors of the tree that some links stand for."""
    return tuple(dict.fromkeys(map(tree.arbor_of, links)))


def lost_wheels(tree: SpurTree, lost: Sequence[str]) -> int:
    """How many wheels are lost with some links."""
    return sum(len(tree.wheels_of(arbor)) for arbor in lost_arbors(tree, lost))


def _asked(tree: SpurTree, lost: Sequence[str], seen: bool) -> dict[str, Any]:
    pairs = [[links[0], other] for arbor, links in tree.joined.items() if arbor not in lost for other in links[1:]]
    return {
        **({"carrier": tree.base.name} if tree.base.is_carrier else {}),
        "add": {
            "wheels": lost_wheels(tree, lost),
            "teeth": list(tree.teeth),
            **({"arbors": len(lost)} if seen else {}),
        },
        **({"idlers": True} if tree.has_idlers else {}),
        **({"given": [{"pair": pair} for pair in pairs]} if pairs else {}),
    }


def _inputs(tree: SpurTree, given: dict[str, Any]) -> dict[str, Any]:
    """The speeds of what bears the arbors and of the first of them."""
    base, frame = tree.base, tree.train.frame
    speeds = {base.name: base.speed, base.source: base.driven + base.speed}
    return {link: given["inputs"].get(link, str(speed)) for link, speed in speeds.items() if link != frame}


def rank_of(arbor: Arbor, found: Reconstructions) -> tuple[int, int] | None:
    """First and last rank by weight that a candidate may have among all, for some weigh the same.

    None if it is not listed.
    """
    wanted = mechanism(arbor)
    return next((one.ranks for one in found.candidates if mechanism(one.arbor) == wanted), None)


def is_all_listed(found: Reconstructions) -> bool:
    """Whether every explanation that is counted is listed."""
    return found.complete and len(found.candidates) == sum(count.mechanisms for count in found.counts)


def _check(tree: SpurTree, lost: Sequence[str]) -> None:
    arbors = [tree.arbor_of(link) for link in lost]
    able = [link for arbor in tree.able if arbor not in arbors for link in tree.links_of(arbor)]
    for link, arbor in zip(lost, arbors, strict=True):
        if arbor == tree.source:
            what, why = f"'{link}' carries the input", "a reconstruction begins there"
        elif arbor not in tree.driven:
            what = f"'{link}' cannot be left out"
            why = why_not(tree.train, link) if link in tree.train.links else "there is no such link"
        elif arbor not in tree.able:
            what, why = f"'{link}' cannot be left out", "it has a ring, and no ring is added"
        elif arbors.count(arbor) > 1:
            what, why = f"'{link}' is left out twice", "an arbor is lost once, with all that is joined to it"
        else:
            continue
        raise QuestionError(Problem(what, why, suggest(link, able)))


def _wheels(tree: SpurTree, given: dict[str, Any], link: str) -> dict[str, Any]:
    """Wheels of a surviving arbor with their counts, and what is told of them."""
    found: dict[str, Any] = {}
    for name in (name for name in tree.train.links[link].wheels if name in tree.counts):
        wheel = given["links"][link]["wheels"][name]
        about = {key: wheel[key] for key in _OF_WHEELS if key in wheel} if isinstance(wheel, dict) else {}
        found[name] = {"teeth": tree.counts[name], **about} if about else tree.counts[name]
    return found


def _shown(tree: SpurTree, given: dict[str, Any], pointer: str) -> dict[str, Any]:
    """How fast a pointer turns: what is expected of it, else its targets that have a tolerance; and seen from what."""
    output = given["outputs"].get(pointer)
    if output is None:
        return {"expect": given["inputs"][pointer]}
    base = tree.train.case(None).outputs[pointer].relative_to
    seen = {} if base in (None, tree.train.frame) else {"relative_to": base}
    if output.get("expect") is not None:
        return seen | {"expect": output["expect"]}
    return seen | {"targets": [target for target in output["targets"] if target.get("tolerance") is not None]}
