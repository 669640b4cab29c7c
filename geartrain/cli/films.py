"""Pictures and films of the turning train as `geartrain view` writes them: their options are the fields of a `Shot`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from inspect import Parameter, Signature
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.cli.common import STANDARD_NAME, Sink, sink, tell
from geartrain.cli.long_runs import progress
from geartrain.cli.option_values import turns as read_turns
from geartrain.cli.option_values import whole
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.decimal_text import plural
from geartrain.viewer.shot import Look, Shot, period_of

if TYPE_CHECKING:
    from geartrain.scene import Scene

_PATIENCE = 2.0  # seconds before a progress bar is shown
SUFFIXES = (".png", ".gif", ".webp", ".mp4")

_TYPED: Mapping[str, Any] = {
    "look": Look,
    "apart": float,
    "seconds": float,
    "fps": int,
    "turntable": float,
    "cutaway": bool,
}  # else text


def with_shot(run: Callable[..., None]) -> Callable[..., None]:
    """The command with an option for each field of `Shot` that says what it is; given to `run` as `shot`, by name."""
    own = [
        Parameter(
            each.name,
            Parameter.KEYWORD_ONLY,
            default=None,
            annotation=Annotated[
                _TYPED.get(each.name, str) | None,
                typer.Option(_flag(each.name), help=each.metadata["help"]),
            ],
        )
        for each in fields(Shot)
        if "help" in each.metadata
    ]
    taken = [each for each in Signature.from_callable(run, eval_str=True).parameters.values() if each.name != "shot"]

    def command(**given: Any) -> None:
        shot = {each.name: given.pop(each.name) for each in own}
        run(**given, shot={name: value for name, value in shot.items() if value is not None})

    parameters = [each.replace(kind=Parameter.KEYWORD_ONLY) for each in taken] + own
    command.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    command.__annotations__ = {each.name: each.annotation for each in parameters}
    command.__doc__, command.__module__ = run.__doc__, run.__module__
    return command


def _flag(name: str) -> str:
    return f"--{name}/--no-{name}" if _TYPED.get(name) is bool else f"--{name}"


@dataclass(frozen=True)
class FilmRequest:
    """What is asked of a picture or film: the form that a flag or the file's suffix says, and what it shows."""

    suffix: str
    shot: Shot

    @classmethod
    def of(
        cls, flags: Mapping[str, bool], out: Path | None, given: Mapping[str, Any], teeth: bool
    ) -> FilmRequest | None:
        """None where a page is asked for. Raises `QuestionError` for two forms at once, or options without any."""
        named = out.suffix.lower() if out is not None else ""
        forms = {f".{form}" for form, wanted in flags.items() if wanted} | ({named} & set(SUFFIXES))
        if len(forms) > 1:
            why = "one command writes one file"
            raise QuestionError(Problem(f"{' and '.join(sorted(forms))} at once", why, "leave all but one out", "view"))
        if not forms and given:
            why = "a page is looked at from all sides, by whoever opens it"
            fix = "add --png, --gif or --mp4, or leave them out"
            raise QuestionError(Problem(f"options of a film: {', '.join(f'--{name}' for name in given)}", why, fix))
        return cls(forms.pop(), _shot(given, teeth)) if forms else None

    def of_turns(self, turns: str | None) -> FilmRequest:
        """The same for so many turns of the lead."""
        return self if turns is None else replace(self, shot=replace(self.shot, turns=read_turns("--turns", turns)))

    def sink(self, path: Path, force: bool) -> Sink:
        """Where it goes; made sure of, with what draws and packs it, before anything is worked out."""
        from geartrain.viewer.browser import check_browser
        from geartrain.viewer.film_formats import check_format

        if path != STANDARD_NAME and not path.suffix and not path.is_dir():
            path = path.with_name(f"{path.name}{self.suffix}")
        found = sink(path, force, (self.suffix,))
        check_format(self.suffix, self.shot)
        check_browser()
        return found

    def write(self, scenes: Sequence[Scene], to: Sink) -> None:
        """Draw it, with a progress bar once it takes long, and write it whole or not at all."""
        from geartrain.viewer.film_frames import film
        from geartrain.viewer.film_parts import film_parts

        if self.suffix == ".png":
            width, height = self.shot.size
            to.write(film(scenes, self.suffix, self.shot), f": {width} by {height}")
            return
        pictures = sum(len(part.moments) for part in film_parts(scenes, self.shot))
        with progress("film", pictures, _PATIENCE) as bar:
            data = film(scenes, self.suffix, self.shot, bar.advance)
        seconds = pictures / self.shot.fps
        to.write(data, f": {plural(pictures, 'picture')} in {seconds:.3g} s, {len(data) / 1000:,.0f} kB")
        if len(scenes) == 1:
            self._tell_period(scenes[0])

    def _tell_period(self, scene: Scene) -> None:
        """Say so where the film does not end as it begins."""
        period = period_of(scene)
        if period is not None and scene.run is None and not self.shot.timed(scene).closes(scene):
            tell(f"it ends otherwise than it begins: a whole period is {_said(period)} turns of the lead")


def _shot(given: Mapping[str, Any], teeth: bool) -> Shot:
    """What is shown, read from the options."""
    found = dict(given)
    if "size" in found:
        found["size"] = _size(found["size"])
    if "at" in found:
        found["at"] = read_turns("--at", found["at"])
    return Shot(**found, teeth=teeth)


def _said(turns: Fraction) -> str:
    return str(turns) if turns.denominator == 1 or len(str(turns)) < 12 else f"{float(turns):.6g}"


def _size(text: str) -> tuple[int, int]:
    """Width and height (px) of what is written as 960x640."""
    sides = text.lower().replace("×", "x").split("x")
    if len(sides) != 2:
        raise QuestionError(Problem(f"'{text}' is no size of a picture", "", "write it as 960x640", "--size"))
    width, height = (whole("--size", side, "number of points", "960") for side in sides)
    return width, height
