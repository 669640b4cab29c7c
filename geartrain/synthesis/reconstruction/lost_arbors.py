"""From a train to evidence of it, as if some of its arbors had been lost: a test of what evidence is worth."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from geartrain.errors import Problem, QuestionError, suggest
from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor
from geartrain.synthesis.reconstruction.reconstruction_result import Reconstructions
from geartrain.synthesis.reconstruction.sameness import mechanism
from geartrain.synthesis.reconstruction.spur_tree import SpurTree
from geartrain.train import Train, declare
from geartrain.train.reconstruction import NEW_ARBOR

_KEPT = ("title", "sources", "unit", "view")
_OF_WHEELS = ("status", "source", "note")


def lost_evidence(tree: SpurTree, lost: Sequence[str]) -> Train:
    """Evidence of a tree of which some arbors are lost.

    What survives are the other arbors with the wheels that mesh in the train, counts as they are used there; every
    pointer with its speed, on its arbor or on one that does not survive. Who meshes with whom is not known. As many
    wheels may be added as are lost, with as many teeth as any wheel of the tree has.

    lost   names of arbors; `QuestionError` for the input, and for what is no arbor of the tree
    """
    return declare(lost_evidence_data(tree, lost))


def lost_evidence_data(tree: SpurTree, lost: Sequence[str]) -> dict[str, Any]:
    """The same with the keys of a declaration."""
    _check(tree, lost)
    train = tree.train
    given = train.model_dump(mode="json", exclude_unset=True, by_alias=True)
    words = "-".join(lost).replace(" ", "-")
    kept = {key: given[key] for key in _KEPT if given.get(key)}
    if "title" in kept:
        kept["title"] += f", without {', '.join(lost)}"
    survivors = [link for link in train.links if link in tree.arbors and link not in lost]
    add = {
        "wheels": sum(len(tree.wheels_of(link)) for link in lost),
        "teeth": [min(tree.counts.values()), max(tree.counts.values())],
    }
    return {
        "name": f"{train.name}-without-{words}",
        **kept,
        "frame": train.frame,
        "links": {train.frame: {}, **{link: {"wheels": _wheels(tree, given, link)} for link in survivors}},
        "inputs": {tree.source: given["inputs"][tree.source]},
        "outputs": {
            name: {"of": NEW_ARBOR if link in lost else link} | _speed(given["outputs"][name])
            for name, link in tree.pointers.items()
        },
        "reconstruct": {"add": add} | ({"idlers": True} if tree.has_idlers else {}),
    }


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
    able = [link for link in tree.driven if link not in lost]
    for link in lost:
        if link == tree.source:
            what, why = f"'{link}' carries the input", "a reconstruction begins there"
        elif link not in tree.driven:
            what = f"'{link}' cannot be left out"
            why = "it is none of the arbors that spur wheels on the frame drive from the input to a pointer"
        elif list(lost).count(link) > 1:
            what, why = f"'{link}' is left out twice", "an arbor is lost once"
        else:
            continue
        raise QuestionError(Problem(what, why, suggest(link, able)))


def _wheels(tree: SpurTree, given: dict[str, Any], link: str) -> dict[str, Any]:
    """Wheels of a surviving arbor with their counts, and what is told of them."""
    found: dict[str, Any] = {}
    for name in tree.wheels_of(link):
        wheel = given["links"][link]["wheels"][name]
        about = {key: wheel[key] for key in _OF_WHEELS if key in wheel} if isinstance(wheel, dict) else {}
        found[name] = {"teeth": tree.counts[name], **about} if about else tree.counts[name]
    return found


def _speed(output: dict[str, Any]) -> dict[str, Any]:
    """How fast a pointer turns: what is expected of it, else its targets that have a tolerance."""
    if output.get("expect") is not None:
        return {"expect": output["expect"]}
    return {"targets": [target for target in output["targets"] if target.get("tolerance") is not None]}
