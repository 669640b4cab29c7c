"""The graph of a train as tables: its adjacency matrix in letters, and its edges."""

from __future__ import annotations

from geartrain.analysis.gear_train import GearTrain
from geartrain.kinematics.graph import adjacency_labels, edge_rows
from geartrain.report.document import Document, Section, Table


def adjacency_table(train: GearTrain) -> Table:
    """Links by links; R(axis) is a turning pair, gear pairs and couplings stand by their ids."""
    names = list(train.declaration.links)
    cells = adjacency_labels(train.declaration)
    return Table(("", *names), [(name, *row) for name, row in zip(names, cells, strict=True)], wide=True)


def describe_adjacency(train: GearTrain) -> Document:
    """The adjacency matrix alone."""
    return Document(f"Adjacency of {train.name}", (), (Section("Matrix", (), (adjacency_table(train),)),))


def describe_edges(train: GearTrain) -> Document:
    """Which two links are joined by what, a row for each joint, gear pair and coupling."""
    table = Table(("link", "link", "joined by", "axis or pair"), edge_rows(train.graph))
    return Document(f"Edges of {train.name}", (), (Section("Edges", (), (table,)),))
