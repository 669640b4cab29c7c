"""What each room shows a reader: numpydoc docstrings with every parameter and an example that runs."""

from __future__ import annotations

import dataclasses
import importlib
import inspect
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from pydantic import BaseModel

from geartrain.numerics.results import field_docs

SHOWING = [
    "analysis",
    "drawing",
    "dynamics",
    "errors",
    "kinematics",
    "numerics",
    "report",
    "scene",
    "search",
    "search.reconstruct",
    "simulation",
    "spherical",
    "teeth",
    "teeth.conjugate",
    "teeth.contact",
    "teeth.outlines",
    "teeth.triangular",
    "train",
    "viewer",
    "workshop",
]
"""Rooms whose `__all__` is complete. The shell shows commands, which `--help` and docs/commands.md describe."""


def public(room: str) -> Iterator[tuple[str, Any]]:
    module = importlib.import_module(f"geartrain.{room}")
    assert module.__all__ == sorted(module.__all__)
    for name in module.__all__:
        yield name, getattr(module, name)


def sections(thing: object) -> dict[str, str]:
    """Title -> text of the sections of a numpydoc docstring."""
    parts = re.split(r"^([A-Z][A-Za-z ]+)\n-{3,}\n", inspect.getdoc(thing) or "", flags=re.M)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def described(text: str) -> set[str]:
    """Names that a section of parameters or attributes describes: `name` or `a, b : type`, the meaning indented."""
    heads = re.findall(r"^(\*{0,2}\w+(?:, \*{0,2}\w+)*)(?: : .+)?\n +\S", text, flags=re.M)
    return {name.lstrip("*") for head in heads for name in head.split(", ")}


def parameters(function: Callable[..., Any]) -> set[str]:
    return {name for name in inspect.signature(function).parameters if name not in ("self", "cls")}


def gaps_of_function(where: str, function: Callable[..., Any]) -> Iterator[str]:
    found = sections(function)
    missing = parameters(function) - described(found.get("Parameters", ""))
    if missing:
        yield f"{where}: no word on {', '.join(sorted(missing))}"
    returned = inspect.signature(function).return_annotation
    if returned not in (None, "None") and not {"Returns", "Yields"} & found.keys():
        yield f"{where}: what it returns"


def gaps_of_class(where: str, kind: type) -> Iterator[str]:
    found = sections(kind)
    if dataclasses.is_dataclass(kind) and not issubclass(kind, BaseModel):
        fields = {field.name for field in dataclasses.fields(kind) if not field.name.startswith("_")}
        missing = fields - described(found.get("Parameters", "")) - field_docs(kind).keys()
        if missing:
            yield f"{where}: no word on {', '.join(sorted(missing))}"
    own = [base for base in kind.__mro__ if base.__module__.split(".")[:2] == kind.__module__.split(".")[:2]]
    for name, method in {name: method for base in reversed(own) for name, method in vars(base).items()}.items():
        method = getattr(method, "__func__", method)
        if not inspect.isfunction(method) or name.startswith("_") or not parameters(method):
            continue
        if hasattr(BaseModel, name):  # pydantic writes it into the class
            continue
        # what overrides another need not say again what the other says
        said = [sections(getattr(base, name)).get("Parameters", "") for base in kind.__mro__ if name in vars(base)]
        missing = parameters(method) - described("\n".join(said))
        if missing:
            yield f"{where}.{name}: no word on {', '.join(sorted(missing))}"


def gaps(where: str, thing: Any) -> Iterator[str]:
    if inspect.isclass(thing):
        yield from gaps_of_class(where, thing)
    elif inspect.isfunction(thing):
        yield from gaps_of_function(where, thing)
    else:
        return
    if ">>>" not in sections(thing).get("Examples", "") and not (
        inspect.isclass(thing) and "See Also" in sections(thing)
    ):
        yield f"{where}: an example (of a result: See Also what gives it)"


@pytest.mark.parametrize("room", SHOWING)
def test_public_names_say_what_goes_in_and_what_comes_out_and_show_it(room: str) -> None:
    assert [gap for name, thing in public(room) for gap in gaps(f"{room}.{name}", thing)] == []


@pytest.mark.parametrize("room", SHOWING)
def test_no_two_fields_of_a_public_class_have_one_meaning(room: str) -> None:
    """Two fields with one docstring were described together, and neither by itself."""
    shared = [
        f"{name}: {meaning}"
        for name, thing in public(room)
        if inspect.isclass(thing)
        for meaning, count in Counter(field_docs(thing).values()).items()
        if count > 1
    ]
    assert shared == []


def test_a_gap_is_found() -> None:
    def bare(turns: int) -> int:
        """Nothing said."""
        return turns

    def full(turns: int) -> int:
        """All said.

        Parameters
        ----------
        turns : int
            Whole turns [turn].

        Returns
        -------
        int
            The same.

        Examples
        --------
        >>> 1
        1
        """
        return turns

    @dataclasses.dataclass(frozen=True)
    class Bare:
        """Nothing said."""

        turns: int

        def after(self, more: int) -> int:
            """Nothing said."""
            return self.turns + more

    assert len(list(gaps("bare", bare))) == 3
    assert list(gaps("full", full)) == []
    assert len(list(gaps("Bare", Bare))) == 3


def test_the_packages_are_attributes_of_geartrain_without_an_import_statement() -> None:
    code = "import geartrain; print(geartrain.teeth.Involute.__name__, hasattr(geartrain, 'tooth'))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split() == ["Involute", "False"]
