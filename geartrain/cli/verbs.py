"""Commands of a group, each imported when it is requested, so that none waits for the imports of another."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar

import typer
from typer.core import TyperGroup

from geartrain.wings import WINGS, has_wing

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

Command = Any
"""A command of click, which typer carries with it or imports, by its version."""


class Verbs(Mapping[str, Command]):
    """The commands of a group by name, each made when it is requested.

    The module of a command has a function `run`, and `context_settings` where it needs any; or a `typer.Typer` named
    `app` for a group.

    Parameters
    ----------
    modules
        Name of each command -> its module, in the order in which `--help` lists them. Commands of a wing that is not
        installed are left out.
    make
        Name -> function, for commands that are not modules.
    entry_points
        Group of entry points (`importlib.metadata`) through which other distributions add commands. It is read only
        when a name is unknown or when all names are listed, because a scan of the installed distributions takes
        longer than most commands.
    """

    def __init__(
        self,
        modules: Mapping[str, str],
        make: Mapping[str, Callable[[], Callable[..., None]]] | None = None,
        entry_points: str | None = None,
    ) -> None:
        self._modules, self._make, self._group = modules, make or {}, entry_points
        self._made: dict[str, Command] = {}

    def __getitem__(self, name: str) -> Command:
        if name not in self._made:
            self._made[name] = self._command(name)
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        absent = {f"geartrain.{name}" for name in WINGS if not has_wing(name)}
        yield from (name for name, module in self._modules.items() if ".".join(module.split(".")[:2]) not in absent)
        yield from self._make
        yield from self._added

    def __len__(self) -> int:
        return sum(1 for _ in self)

    @cached_property
    def _added(self) -> dict[str, EntryPoint]:
        """Commands of other distributions."""
        if self._group is None:
            return {}
        from importlib.metadata import entry_points

        known = {*self._modules, *self._make}
        return {each.name: each for each in entry_points(group=self._group) if each.name not in known}

    def _command(self, name: str) -> Command:
        settings = None
        if name in self._make:
            run = self._make[name]()
        else:
            module = self._module(name)
            if hasattr(module, "app"):
                command = typer.main.get_command(module.app)
                command.name = name
                return command
            run, settings = module.run, getattr(module, "context_settings", None)
        one = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
        one.command(name, context_settings=settings)(run)
        return typer.main.get_command(one)

    def _module(self, name: str) -> Any:
        """The module of a command. Raises `KeyError` for an unknown name and for a wing that is not installed."""
        if name in self._modules:
            try:
                return import_module(self._modules[name])
            except ModuleNotFoundError as error:
                if error.name not in {f"geartrain.{each}" for each in WINGS}:
                    raise
                raise KeyError(name) from None
        return self._added[name].load()


class LazyGroup(TyperGroup):
    """A group of commands that are imported when they are requested."""

    verbs: ClassVar[Verbs]

    def __init__(self, *given: Any, **more: Any) -> None:
        super().__init__(*given, **more)
        self.commands = self.verbs  # type: ignore[assignment]
