"""The verbs, one file each: a verb is imported when it is asked for, so that none waits for the imports of another."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from importlib import import_module
from typing import Any, ClassVar

import typer
from typer.core import TyperGroup

Command = Any
"""A command of click, which typer carries with it or imports, by its version."""


class Verbs(Mapping[str, Command]):
    """The commands of a group by their names, each made when it is asked for.

    A verb is a module of `package` with a function `run`, and with `context_settings` where it has any; or with a
    `typer.Typer` named `app` for a group.

    Parameters
    ----------
    package
        Where the modules are.
    names
        The verbs, as `--help` lists them.
    make
        Name -> command, for verbs that are no modules; None where the name is that of a module.
    """

    def __init__(
        self,
        package: str,
        names: tuple[str, ...],
        make: Callable[[str], Callable[..., None] | None] = lambda name: None,
    ) -> None:
        self.package, self.names, self._make = package, names, make
        self._made: dict[str, Command] = {}

    def __getitem__(self, name: str) -> Command:
        if name not in self.names:
            raise KeyError(name)
        if name not in self._made:
            self._made[name] = self._command(name)
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)

    def _command(self, name: str) -> Command:
        run, settings = self._make(name), None
        if run is None:
            module = import_module(f"{self.package}.{name}")
            if hasattr(module, "app"):
                command = typer.main.get_command(module.app)
                command.name = name
                return command
            run, settings = module.run, getattr(module, "context_settings", None)
        one = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
        one.command(name, context_settings=settings)(run)
        return typer.main.get_command(one)


class LazyGroup(TyperGroup):
    """A group of verbs that are imported when they are asked for."""

    verbs: ClassVar[Verbs]

    def __init__(self, *given: Any, **more: Any) -> None:
        super().__init__(*given, **more)
        self.commands = self.verbs  # type: ignore[assignment]
