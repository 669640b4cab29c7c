"""Groups of commands that are imported on request, and exit codes of the command line.

An internal error never has the exit code of a verdict.
"""

from __future__ import annotations

import errno
import os
import re
import sys
import tempfile
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar

import typer
from typer.core import TyperGroup

from geartrain.cli.common import INTERRUPTED, NOT_USABLE, complain, tell
from geartrain.errors import GearTrainError, Problem, QuestionError, nearest_names, printable, suggest
from geartrain.wings import WINGS, has_wing

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint


Command = Any
"""Command of click. Depending on its version, typer contains click or imports it."""


class Verbs(Mapping[str, Command]):
    """Commands of a group, keyed by name. A command is created when it is requested.

    A command is a function (`module:function`), or a module with a function `run` and optional `context_settings`. A
    group is a module with a `typer.Typer` named `app`.

    Parameters
    ----------
    modules
        Function or module of each command, keyed by the command's name, in the order in which `--help` lists the
        commands. Commands of an optional part that is not installed are omitted.
    entry_points
        Group of entry points (`importlib.metadata`) through which other distributions add commands. The group is read
        only when a name is unknown or when all names are listed, because a scan of the installed distributions takes
        longer than most commands.
    panels
        Names of the commands below each heading in `--help`, keyed by heading.
    """

    def __init__(
        self,
        modules: Mapping[str, str],
        entry_points: str | None = None,
        panels: Mapping[str, Sequence[str]] | None = None,
    ) -> None:
        self._modules, self._group = modules, entry_points
        self._made: dict[str, Command] = {}
        self._panels = {name: title for title, names in (panels or {}).items() for name in names}

    def __getitem__(self, name: str) -> Command:
        if name not in self._made:
            self._made[name] = self._command(name)
            self._made[name].rich_help_panel = self._panels.get(name)
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        # a command of an optional part is listed only if that part is installed
        absent = {f"geartrain.{name}" for name in WINGS if not has_wing(name)}
        yield from (name for name, module in self._modules.items() if ".".join(module.split(".")[:2]) not in absent)
        yield from self._added

    def __len__(self) -> int:
        return sum(1 for _ in self)

    @cached_property
    def _added(self) -> dict[str, EntryPoint]:
        """Entry points of commands that other installed packages add to the group, keyed by name."""
        if self._group is None:
            return {}
        from importlib.metadata import entry_points

        # other distributions can add commands, but not replace those of this group; other kinds have a prefix
        found = (each for each in entry_points(group=self._group) if "." not in each.name)
        return {each.name: each for each in found if each.name not in self._modules}

    def _command(self, name: str) -> Command:
        found = self._load(name)
        if hasattr(found, "app"):
            command = typer.main.get_command(found.app)
            command.name = name
            return command
        run, settings = getattr(found, "run", found), getattr(found, "context_settings", None)
        one = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
        one.command(name, context_settings=settings)(run)
        command = typer.main.get_command(one)
        # typer keeps line breaks within paragraphs, prints the type of a flag, and a maximum that is only a safeguard
        command.help = re.sub(r"(?<!\n)\n(?!\n)", " ", command.help or "")
        for param in command.params:
            if getattr(param, "is_flag", False):
                param.metavar = ""
            if (getattr(param, "max", None) or 0) >= 10**9:
                param.max = None  # type: ignore[attr-defined]
        return command

    def _load(self, name: str) -> Any:
        """Import the function or module of a command; raise `KeyError` if it is unknown or not installed."""
        if name in self._modules:
            module, _, function = self._modules[name].partition(":")
            try:
                found = import_module(module)
                return getattr(found, function) if function else found
            except ModuleNotFoundError as error:
                if error.name not in {f"geartrain.{each}" for each in WINGS}:
                    raise
                raise KeyError(name) from None
        return self._added[name].load()


class LazyGroup(TyperGroup):
    """Group of commands. A command is imported when it is requested."""

    verbs: ClassVar[Verbs]

    def __init__(self, *given: Any, **more: Any) -> None:
        super().__init__(*given, **more)
        self.commands = self.verbs  # type: ignore[assignment]

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[str | None, Any, list[str]]:
        """Return the command that is named in `args`, as click requires; raise `QuestionError` for unknown names."""
        name = args[0]
        # shell completion parses incomplete lines (resilient), which must not raise errors
        if name not in self.verbs and not name.startswith("-") and not ctx.resilient_parsing:
            fix = suggest(name, self.verbs, f"`{ctx.command_path} --help` lists the commands")
            raise QuestionError(Problem("unknown command", "", fix, name))
        return super().resolve_command(ctx, args)


# ----------------------------------------------------------------------------------------------------------- exit codes


# 141 = 128 + SIGPIPE, as shells report a process that this signal ended
FAULT, READER_GONE = 3, 141
TRACEBACK = "GEARTRAIN_TRACEBACK"
"""Environment variable; if it is set, the traceback of an internal error is also printed."""

_DISK = {errno.ENOSPC, errno.EIO, errno.EFBIG, errno.EBADF, getattr(errno, "EDQUOT", errno.ENOSPC)}


class _ReaderGoneError(Exception):
    """Error that is raised if the reader of standard output has closed it."""


class EndingGroup(TyperGroup):
    """Group of commands that handles closed pipes and Ctrl-C itself; exit codes of typer have other meanings here."""

    def make_context(self, *given: Any, **more: Any) -> Any:
        """Parse the command line and return the context. The options `--help` and `--version` exit here."""
        with _translated_exits():
            return super().make_context(*given, **more)

    def invoke(self, ctx: Any) -> Any:
        """Run the command that was requested on the command line."""
        with _translated_exits():
            return super().invoke(ctx)


@contextmanager
def _translated_exits() -> Iterator[None]:
    """Convert usage errors, closed pipes and Ctrl-C to exceptions of this package, which typer does not report."""
    try:
        yield
    except BrokenPipeError:
        raise _ReaderGoneError from None
    except KeyboardInterrupt:
        tell("stopped")
        raise typer.Exit(INTERRUPTED) from None
    except Exception as error:
        # usage errors are recognised by attributes, as in `usage_problem`
        if hasattr(error, "format_message") and hasattr(error, "ctx") and type(error).__name__ != "NoArgsIsHelpError":
            raise QuestionError(usage_problem(error)) from None
        raise


def usage_problem(error: Any) -> Problem:
    """Return a usage error of typer, recognised by its attributes, as a problem in the form of all other errors."""
    context, param = error.ctx, getattr(error, "param", None)
    see = f"`{f'{context.command_path} ' if context else ''}--help` lists the arguments and options"
    what = str(error.message).rstrip(".").removeprefix("Value error, ")
    if (name := getattr(error, "option_name", None)) is not None:
        if not what.startswith("No such option"):
            kind = "the value of this option is missing" if "requires" in what else "this option takes no value"
            return Problem(kind, "", see, name)
        known = [each for one in context.command.params for each in one.opts if each.startswith("--")]
        close = nearest_names(name.lstrip("-"), [each.lstrip("-") for each in known])
        fix = f"did you mean --{' or --'.join(close)}?" if close else see
        if any("-p" in one.opts for one in context.command.params):
            fix += f"; parameters of the tooth form are given as -p {name.lstrip('-')}=VALUE"
        return Problem("unknown option", "", fix, name)
    if extra := re.fullmatch(r"Got unexpected extra argument\S* \((.*)\)", what):
        return Problem("unexpected argument", "", see, extra[1])
    hint = getattr(error, "param_hint", None) or ""
    place = hint if isinstance(hint, str) else ", ".join(hint)
    if param is not None and not place:
        place = param.opts[0] if param.param_type_name == "option" else param.metavar or param.name.upper()
    place = place.strip("{}.'")
    if not what:  # a required parameter
        kind = param.param_type_name if param is not None else "argument"
        return Problem(f"this {kind} is required", "", f"give {place}; {see}", place)
    if one := re.fullmatch(r"'(.*)' is not one of ('.*')", what):
        return Problem(f"'{one[1]}' is not a valid value", "", suggest(one[1], re.findall("'(.*?)'", one[2])), place)
    what = what.partition(", unable to parse")[0].replace("Input should be", "it must be")
    return Problem(what[:1].lower() + what[1:], "", see, place)


def guarded(run: Callable[[], Any]) -> int:
    """Call a function that runs the command line, report errors on standard error, and return the exit code."""
    try:
        code = _code(run)
        # errors of the disk or a closed pipe may appear only when the buffer is written
        sys.stdout.flush()
    except GearTrainError as error:
        complain(error)
        return NOT_USABLE
    except KeyboardInterrupt:
        return _interrupted()
    except (BrokenPipeError, _ReaderGoneError):
        _discard_output()
        return READER_GONE
    except Exception as error:
        # an error without a file name is one of standard output
        if isinstance(error, OSError) and error.filename is None and error.errno in _DISK:
            fix = "free disk space, or write to another disk"
            complain(GearTrainError(Problem("the result cannot be written", str(error), fix, "standard output")))
            _discard_output()
            return NOT_USABLE
        _report_internal_error(error)
        return FAULT
    return _interrupted() if code == INTERRUPTED else code


def _interrupted() -> int:
    """Return the exit code for Ctrl-C, after clearing CPython's record of the interrupt.

    An interrupt during the evaluation of a string is recorded even if it is caught, and kills `python -m` at exit.
    """
    eval("0")
    return INTERRUPTED


def _code(run: Callable[[], Any]) -> int:
    try:
        run()
    except SystemExit as ended:
        if isinstance(ended.__context__, BrokenPipeError):  # rich, which prints the help, then exits with code 1
            raise _ReaderGoneError from None
        return ended.code if isinstance(ended.code, int) else 0 if ended.code is None else FAULT
    return 0


def _discard_output() -> None:
    """Send the remaining output to the null device, so that the interpreter does not report an error at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _report_internal_error(error: Exception) -> None:
    """Report an internal error in one line on standard error, and write its traceback to a file."""
    text = "".join(traceback.format_exception(error))
    said = printable(str(error).partition("\n")[0])
    kept = _write_traceback(text)
    how = f"attach {kept} to a bug report" if kept else f"set {TRACEBACK}=1, and attach the traceback to a bug report"
    tell(f"internal error: {type(error).__name__}: {said}; this is an error in geartrain: {how}")
    if os.environ.get(TRACEBACK):
        tell(text)


def _write_traceback(text: str) -> str:
    """Write a traceback and the command line to a new file; return its name, or "" if it cannot be created."""
    import platform
    from importlib.metadata import version

    head = f"geartrain {version('geartrain')}, Python {platform.python_version()}, {platform.platform()}\n"
    requested = f"command: {sys.argv!r}\n\n"
    try:
        # readable only by the user, because paths may be confidential
        handle, name = tempfile.mkstemp(prefix="geartrain-error-", suffix=".txt", text=True)
        with os.fdopen(handle, "w", encoding="utf-8", errors="backslashreplace") as file:
            file.write(head + requested + text)
    except OSError:
        return ""
    return name
