"""A second, naive solver: raw Willis rows and dense elimination over the rationals.

Nothing is imported from the package under test. The carrier of a gear pair is the vertex of the tree path at which the
axis label changes.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import networkx as nx

Matrix = list[list[Fraction]]


@dataclass(frozen=True)
class Reference:
    """Results of the naive solver: kind of the verdict, determined speeds, and counts."""

    kind: str
    speeds: dict[str, Fraction]
    undetermined: set[str]
    mobility: int
    rank: int
    still: set[str]
    carriers: dict[str, str]


def turning_graph(data: Mapping[str, Any]) -> nx.Graph:
    graph = nx.Graph()
    graph.add_nodes_from(data["links"])
    for joint in data["revolutes"]:
        graph.add_edge(*joint["pair"], axis=joint["axis"])
    return graph


def find_carrier(graph: nx.Graph, i: str, j: str) -> str | None:
    """Return the single vertex of the tree path i..j at which the label changes; None if there is not exactly one."""
    path = nx.shortest_path(graph, i, j)
    labels = [graph.edges[pair]["axis"] for pair in itertools.pairwise(path)]
    changes = [path[at + 1] for at in range(len(labels) - 1) if labels[at] != labels[at + 1]]
    return changes[0] if len(changes) == 1 else None


def wheel_table(data: Mapping[str, Any]) -> dict[str, tuple[str, int, bool]]:
    """Return a mapping of wheel id to (link, teeth, internal)."""
    table = {}
    for link, part in data["links"].items():
        for name, wheel in ((part or {}).get("wheels") or {}).items():
            teeth, internal = (
                (wheel, False) if isinstance(wheel, int) else (wheel["teeth"], bool(wheel.get("internal", False)))
            )
            table[name] = (link, teeth, internal)
    return table


def pair_name(gear: Mapping[str, Any]) -> str:
    return gear.get("id") or "~".join(gear["pair"])


def willis_rows(data: Mapping[str, Any]) -> tuple[list[dict[str, Fraction]], dict[str, str]]:
    """Return the row w_i - tau w_j + (tau - 1) w_k = 0 of each pair, and the row of each coupling.

    The row of a coupling is w_slot - m w_pin - (1 - m) w_carrier = 0.
    """
    graph, wheels = turning_graph(data), wheel_table(data)
    rows, carriers = [], {}
    for gear in data.get("gears", ()):
        (i, z_i, ring_i), (j, z_j, ring_j) = (wheels[name] for name in gear["pair"])
        tau = Fraction(z_j, z_i) * (1 if ring_i or ring_j else -1)
        rows.append(_row(carriers, graph, pair_name(gear), i, j, tau))
    for coupling in data.get("couplings", ()):
        winding = Fraction(0 if coupling["kind"] == "pin_follower" else 1)
        name = coupling.get("id") or f"{coupling['pin']}~{coupling['slot']}"
        rows.append(_row(carriers, graph, name, coupling["slot"], coupling["pin"], winding))
    return rows, carriers


def _row(carriers: dict[str, str], graph: nx.Graph, name: str, i: str, j: str, tau: Fraction) -> dict[str, Fraction]:
    carrier = find_carrier(graph, i, j)
    assert carrier is not None, f"the strategy built a pair without a carrier: {name}"
    carriers[name] = carrier
    row: dict[str, Fraction] = {}
    for link, value in ((i, Fraction(1)), (j, -tau), (carrier, tau - 1)):
        row[link] = row.get(link, Fraction(0)) + value
    return row


def echelon(matrix: Matrix, columns: int) -> list[int]:
    """Apply Gauss-Jordan elimination in place to the first `columns` columns; return the pivot columns by row."""
    pivots: list[int] = []
    for column in range(columns):
        lead = next((r for r in range(len(pivots), len(matrix)) if matrix[r][column]), None)
        if lead is None:
            continue
        top = len(pivots)
        matrix[top], matrix[lead] = matrix[lead], matrix[top]
        scale = matrix[top][column]
        matrix[top] = [value / scale if value else value for value in matrix[top]]
        for r, row in enumerate(matrix):
            if r != top and row[column]:
                factor = row[column]
                matrix[r] = [
                    value - factor * above if above else value for value, above in zip(row, matrix[top], strict=True)
                ]
        pivots.append(column)
    return pivots


def _dense(
    rows: Sequence[tuple[Mapping[str, Fraction], Fraction]], links: Sequence[str]
) -> tuple[Matrix, list[int], bool]:
    zero = Fraction(0)
    matrix = [[row.get(link, zero) for link in links] + [right] for row, right in rows]
    pivots = echelon(matrix, len(links))
    consistent = not any(row[-1] for row in matrix[len(pivots) :])
    return matrix, pivots, consistent


def _known(matrix: Matrix, pivots: Sequence[int], links: Sequence[str]) -> dict[str, Fraction]:
    """Return the links whose speed involves no free column."""
    return {
        links[column]: row[-1]
        for row, column in zip(matrix, pivots, strict=False)
        if not any(value for other, value in enumerate(row[:-1]) if other != column)
    }


def rank_of(rows: Sequence[Mapping[str, Fraction]], links: Sequence[str]) -> int:
    return len(_dense([(row, Fraction(0)) for row in rows], links)[1])


def rigid_rows(data: Mapping[str, Any]) -> list[dict[str, Fraction]]:
    """Return one row for every turning pair that a fixed link or a lock closes.

    Two links are one body if all links between them are, provided that two or three axes are on the path: rotations
    about two different lines are independent, and three axes form a triangle. Four axes form a four-bar linkage, which
    this solver does not treat.
    """
    graph, frame, rows = turning_graph(data), data.get("frame", "frame"), []
    bodies = nx.Graph()
    bodies.add_nodes_from(data["links"])
    waiting = [(link, frame) for link in data.get("fixed", ())] + [tuple(pair) for pair in data.get("locks", ())]
    while waiting:
        for pair in waiting:
            path = nx.shortest_path(graph, *pair)
            labels = [graph.edges[step]["axis"] for step in itertools.pairwise(path)]
            ends = [0, *(at for at in range(1, len(labels)) if labels[at] != labels[at - 1]), len(labels)]
            steps = [
                (path[a], path[b]) for a, b in itertools.pairwise(ends) if not nx.has_path(bodies, path[a], path[b])
            ]
            if len(steps) <= 3:
                break
        else:
            raise LinkageError
        waiting.remove(pair)
        bodies.add_edges_from(steps)
        rows += [
            {link: Fraction(sign) for link, sign in zip(step, (1, -1), strict=True) if link != frame} for step in steps
        ]
    return rows


class LinkageError(Exception):
    """A rigid connection across four axes or more."""


def is_a_linkage(data: Mapping[str, Any]) -> bool:
    """Return True if fixed or locked links form a linkage, which is rejected."""
    try:
        rigid_rows(data)
    except LinkageError:
        return True
    return False


def solve_naively(data: Mapping[str, Any]) -> Reference:
    """Return the result for plain data: teeth as integers, inputs as fractions or integers."""
    frame = data.get("frame", "frame")
    links = [link for link in data["links"] if link != frame]
    rows, carriers = willis_rows(data)
    zero = Fraction(0)
    own = [(row, zero) for row in rows]
    bare, bare_pivots, _ = _dense(own, links)
    held = own + [(row, zero) for row in rigid_rows(data)]
    quiet, quiet_pivots, _ = _dense(held, links)
    motionless = set(_known(quiet, quiet_pivots, links))
    inputs = {link: Fraction(speed) for link, speed in data.get("inputs", {}).items()}
    matrix, pivots, consistent = _dense(held + [({link: Fraction(1)}, speed) for link, speed in inputs.items()], links)
    speeds: dict[str, Fraction] = {}
    if not consistent:
        stuck = any(speed and link in motionless for link, speed in inputs.items())
        kind = "locked" if stuck else "contradictory"
    elif len(quiet_pivots) == len(links) and not any(inputs.values()):
        kind = "locked"
        speeds = dict.fromkeys([frame, *links], zero)
    else:
        speeds = {frame: zero, **_known(matrix, pivots, links)}
        kind = "determined" if len(speeds) == len(links) + 1 else "free"
    return Reference(
        kind,
        speeds,
        set(data["links"]) - set(speeds),
        len(links) - len(bare_pivots),
        len(bare_pivots),
        set(_known(bare, bare_pivots, links)),
        carriers,
    )
