"""Which options belong to which search: one that would be passed over in silence is refused."""

from __future__ import annotations

from typing import Literal

import typer

Subject = Literal["a ratio", "the fractions on the way", "a train", "an epicyclic set", "an orrery"]

_FORM = {"wanted", "kind", "csv", "json", "out", "force", "workers"}
_LIST = {"tolerance", "best", "by", "pick"}
_RULES = {
    *("planets", "clearance", "undercut", "interference", "largest_radius", "addendum", "ring_addendum", "least"),
    *("most_teeth", "shift", "coaxial", "hunting", "different", "closure"),
}
_RATIO = {"counts", "wheels", "pinions", "per"}
_PAIRING = {"stages", "internal", "hunting", "reverted", "different", "most_total"}
_LONG = {"scheduler", "resume"}
_KNOWN: dict[Subject, set[str]] = {
    "a ratio": _FORM | _LIST | _RATIO | _PAIRING | _LONG,
    "the fractions on the way": _FORM | _RATIO | {"approximants"},
    "a train": _FORM | _LIST | _RULES | _LONG | {"free", "state", "where"},
    "an epicyclic set": _FORM | _LIST | {"counts", "mode", "ratio_is", "planets", "clearance", "per", "shift"},
    "an orrery": _FORM | {"counts", "tolerance", "effort", "walk"},
}
_SPELLED = {"counts": "--range", "coaxial": "--coaxial/--no-coaxial"}


def check(context: typer.Context, subject: Subject) -> None:
    """`BadParameter` for options that were given and that the search for this subject does not know."""
    foreign = [
        _SPELLED.get(name, f"--{name.replace('_', '-')}")
        for name in context.params
        if name not in _KNOWN[subject] and _given(context, name)
    ]
    if foreign:
        raise typer.BadParameter(f"this is not asked of {subject}; leave it out", param_hint=", ".join(foreign))


def check_texts(context: typer.Context, texts: list[str]) -> None:
    """Negative ratios pass as arguments; anything else with a dash in front is an option that there is not."""
    for text in texts:
        if text.startswith("-") and not text[1:2].isdigit() and text[1:2] != ".":
            raise typer.BadParameter(f"there is no option '{text}'; {context.command_path} -h lists them")


def _given(context: typer.Context, name: str) -> bool:
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"
