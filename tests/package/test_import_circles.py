"""No module of the package imports, even for a type or when it is called, what imports it."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from functools import cache

import networkx as nx
from places import ROOT


@cache
def modules() -> Mapping[str, ast.Module]:
    """The package as syntax trees, by dotted name."""
    found = {}
    for path in sorted((ROOT / "geartrain").rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        found[name] = ast.parse(path.read_text(encoding="utf-8"))
    return found


def packages() -> set[str]:
    return {name.rpartition(".")[0] for name in modules()}


def source(name: str, thing: str) -> str:
    """The module that a name is from: one that a package hands on is that of the module it hands it on from."""
    if f"{name}.{thing}" in modules():
        return f"{name}.{thing}"
    if name in packages():
        for module, own in imports(name):
            if own == thing:
                return source(module, thing)
    return name


@cache
def imports(name: str) -> tuple[tuple[str, str], ...]:
    """Every `from module import thing` of a module: at its head, for types, and inside functions."""
    nodes = (node for node in ast.walk(modules()[name]) if isinstance(node, ast.ImportFrom))
    return tuple((node.module, each.name) for node in nodes if node.module in modules() for each in node.names)


def arrows() -> Iterator[tuple[str, str]]:
    """Who imports what; packages only hand names on."""
    for name in modules():
        if name not in packages():
            yield from ((name, source(module, thing)) for module, thing in imports(name))


def circles(graph: nx.DiGraph[str]) -> list[list[str]]:
    return [sorted(each) for each in nx.strongly_connected_components(graph) if len(each) > 1]


def test_no_modules_import_each_other() -> None:
    graph = nx.DiGraph((one, other) for one, other in arrows() if one != other)
    assert graph.has_edge("geartrain.analysis.gear_train", "geartrain.dynamics.train_mechanics"), "inside a function"
    assert graph.has_edge("geartrain.dynamics.torques.train_torques", "geartrain.dynamics.train_mechanics"), (
        "for a type"
    )
    assert graph.has_edge("geartrain.drawing.power_sankey", "geartrain.dynamics.torques.power_flow"), "by its room"
    assert circles(graph) == []


def test_a_circle_is_found() -> None:
    graph = nx.DiGraph((one, other) for one, other in arrows() if one != other)
    graph.add_edge("geartrain.dynamics.train_mechanics", "geartrain.dynamics.torques.train_torques")
    assert circles(graph) != []


def test_no_sources_of_the_page_import_each_other() -> None:
    folder = ROOT / "geartrain" / "viewer" / "src"
    graph: nx.DiGraph[str] = nx.DiGraph()
    for path in sorted(folder.rglob("*.js")):
        for relative in re.findall(r'from "(\..+?\.js)"', path.read_text(encoding="utf-8")):
            graph.add_edge(str(path.relative_to(folder)), str((path.parent / relative).resolve().relative_to(folder)))
    assert graph.has_edge("plan.js", "extent.js")
    assert circles(graph) == []
