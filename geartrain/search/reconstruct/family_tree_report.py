"""The family tree of candidates as lines of a document."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from geartrain.report.document import Branch, SceneText, Section
from geartrain.search.reconstruct.candidate_findings import FamilyBranch, FamilyTrain
from geartrain.search.reconstruct.reconstruction_facts import many, share_text

_MOST_BRANCHES = 60
_MOST_TRAINS = 6


def family_section(tree: Sequence[FamilyBranch], turning: int = 0) -> Iterator[Section]:
    """The tree; the first so many trains turn on the page."""
    if not tree:
        return
    shown = set(sorted(range(len(tree)), key=lambda at: -tree[at].share)[:_MOST_BRANCHES])
    below: dict[int, list[int]] = {}
    for at, branch in enumerate(tree):
        if branch.parent is not None:
            below.setdefault(branch.parent, []).append(at)

    def lines(places: Sequence[int]) -> Iterator[Branch]:
        for at in places:
            if at in shown:
                yield _branch(tree[at], turning, list(lines(below.get(at, []))))
        left = [tree[at] for at in places if at not in shown]
        if left:
            share = share_text(float(sum(branch.share for branch in left)))
            trains = many(sum(branch.mechanisms for branch in left), "train")
            yield Branch(f"{many(len(left), 'lighter branch').replace('branchs', 'branches')}: {share}, {trains}")

    said = [
        "Meshes from the input on, the driving wheel first, along the path to each pointer in turn; a pointer stands "
        "in brackets at its arbor. Each branch has its share of the weight. Trains at one end differ in counts alone."
    ]
    yield Section("The family tree", said, branches=list(lines([0])))


def _branch(branch: FamilyBranch, turning: int, below: Sequence[Branch]) -> Branch:
    meshes = ", ".join(branch.meshes) or "the input"
    share, trains = share_text(float(branch.share)), branch.trains
    if len(trains) == 1 and not below:
        return Branch(_scene(f"{meshes}: {share}, {_train(trains[0])}", trains[0].rank, turning))
    ends = [
        Branch(_scene(f"{share_text(float(train.share))}, {_train(train)}", train.rank, turning))
        for train in trains[:_MOST_TRAINS]
    ]
    if len(trains) > _MOST_TRAINS:
        ends.append(Branch(f"{len(trains) - _MOST_TRAINS} more"))
    return Branch(f"{meshes}: {share}, {many(branch.mechanisms, 'train')}", [*ends, *below])


def _train(train: FamilyTrain) -> str:
    counts = ", ".join(f"{wheel} {teeth}" for wheel, teeth in train.counts.items())
    return f"rank {train.rank}" + (f" with {counts}" if counts else "")


def _scene(text: str, rank: int, turning: int) -> str:
    return SceneText(text, rank) if rank <= turning else text
