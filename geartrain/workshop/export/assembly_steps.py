"""How the parts of a train are put together, step by step, in the order of heights."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

from geartrain.scene.parts.arbor_columns import AxisBearing, AxisColumn
from geartrain.scene.parts.turned_parts import rod_name

if TYPE_CHECKING:
    from geartrain.scene.parts.frame_plates import FramePlates
    from geartrain.scene.solids.solid_assembly import SolidModel


@dataclass(frozen=True, slots=True)
class AssemblyStep:
    """One step: what is done, which parts come in by it, and whether a picture shows them; what hangs is too tall."""

    text: str
    parts: tuple[str, ...]
    shown: bool = True


def assembly_steps(work: SolidModel) -> list[AssemblyStep]:
    """Arbors and their wheels, what carriers bear, the back plate with studs, all arbors, the front plate, dials."""
    return [] if work.frame is None else list(_Steps(work, work.frame).all())


class _Steps:
    def __init__(self, work: SolidModel, frame: FramePlates) -> None:
        self.work, self.frame, self.plan = work, frame, frame.plan
        self.known = {part.name for part in work.parts}
        self.low, self.high = (
            next(side for side, faces in frame.sides.items() if faces == each)
            for each in (self.plan.places.back, self.plan.places.front)
        )

    def all(self) -> Iterator[AssemblyStep]:
        for column in self.plan.all_columns:
            yield from self._column(column)
        yield from self._pins()
        for plate in self.plan.turning:
            posts = [post.name for post in self.frame.posts if plate.disc.name in post.through]
            tail = ", pins through the ring" if plate.ring else ""
            yield self._step(
                f"Fix '{plate.disc.name}' to '{plate.disc.link}'{tail}", [plate.disc.name, plate.ring, *posts]
            )
        yield from self._carried()
        base = self.plan.stack.frame
        pillars = [name for name in self.known if name.startswith("pillar ")]
        posts = [post.name for post in (*self.frame.posts, *self.frame.pins) if post.link == base]
        rings = [disc.name for disc in self.plan.discs if not disc.hub and disc.link == base]
        pins = " and pins" if any(each.link == base for each in self.frame.standing) else ""
        yield self._step(
            f"Press the pillars, and the posts{pins} of rings, into the {self.low} plate",
            [f"{base} {self.low} plate", *sorted(pillars), *posts, *rings],
        )
        yield from self._studs(AxisBearing.BACK_STUD, self.low)
        yield from self._through()
        yield from self._studs(AxisBearing.FRONT_STUD, self.high)
        yield self._step(
            f"Lead all upper pivots into the {self.high} plate, press it on the pillars, and try the end shake of each "
            "arbor",
            [f"{base} {self.high} plate"],
        )
        yield from self._bridge()
        yield from self._across()
        if self.work.dials:
            names = [dial.name for dial in self.work.dials]
            feet = [foot.name for dial in self.work.dials for foot in dial.feet]
            yield self._step(
                f"Press the feet into {', '.join(names)} and into the plate before which each stands, and put hands "
                "on the arbors",
                [*names, *feet],
            )
        if "pendulum cock" in self.known:
            yield self._step("Press the cock of the pendulum into its plate", ["pendulum cock"])
            yield replace(self._step("Hang the pendulum on its cock", ["pendulum rod", "pendulum bob"]), shown=False)
        if "weight" in self.known:
            yield replace(self._step("Hang the weight on a line round its barrel", ["weight"]), shown=False)
        yield AssemblyStep("Turn it by the lead through a whole turn of the slowest wheel before it is oiled", ())

    def _across(self) -> Iterator[AssemblyStep]:
        """Arms of pins, cages of carriers and brackets of arbors that lie across the plates."""
        arms = sorted(name for name in self.known if name.endswith(" pin arm"))
        cages = [part.name for cage in self.work.cages for part in cage.parts]
        brackets = [bracket.part.name for bracket in self.work.brackets]
        for names, text in (
            (arms, "Fix the arms to the arbors of their links, pins outwards"),
            (cages, "Fix the posts of the cages to their carriers, and hang the arbors across in the eyes"),
            (brackets, "Screw the brackets to the plates, arbors between them"),
        ):
            if names:
                yield self._step(text, names)

    def _step(self, text: str, parts: Sequence[str]) -> AssemblyStep:
        return AssemblyStep(text, tuple(name for name in parts if name in self.known))

    def _column(self, column: AxisColumn) -> Iterator[AssemblyStep]:
        """Which wheels go on which arbor or pipe, and which pipes over which."""
        for member in column.members:
            every = [disc.name for disc in sorted(member.discs, key=lambda disc: disc.low)]
            wheels = [name for name in every if name not in self.plan.cut]
            what = "pipe" if member.inner else "arbor"
            if wheels:
                order = ", from below in this order" if len(wheels) > 1 else ""
                spacers, collets = self._sleeves(every)
                order += _with(wheels, spacers, collets)
                barrel = self._barrel(every)
                text = f"Fix {', '.join(wheels)} on the {what} of '{member.link}'{order}"
                text += ", its barrel beside it" if barrel else ""
                yield self._step(text, [rod_name(column, member), *every, *spacers, *collets, *barrel])
                yield from self._on_eccentrics(every)
                yield from self._plated_pins(every)
        pipes = [member for member in column.members if member.inner]
        if pipes and not column.is_stud:
            links = ", ".join(member.link for member in pipes)
            text = f"On axis {column.axis} slide on the pipes, innermost first: {links}"
            yield self._step(text, [rod_name(column, member) for member in pipes])

    def _sleeves(self, names: Sequence[str]) -> tuple[list[str], list[str]]:
        """Spacers between neighbours of some wheels, and their collets."""
        spacers = (f"spacer {low} to {high}" for low, high in pairwise(names))
        collets = (f"collet of {name}" for name in names)
        return [each for each in spacers if each in self.known], [each for each in collets if each in self.known]

    def _barrel(self, wheels: Sequence[str]) -> list[str]:
        """That is fixed to one of some wheels."""
        barrel = self.frame.barrel
        return [] if barrel is None or barrel.wheel not in wheels else [barrel.part.name]

    def _pins(self) -> Iterator[AssemblyStep]:
        for name, cut in self.work.cut_couplings.items():
            if cut.pin is None:
                continue
            pins = [f"{name} pin {at + 1}" for at in range(len(cut.coupling.pins_at))] or [f"{name} pin"]
            yield self._step(f"Press the pin{'s'[: len(pins) - 1]} of '{name}' into {cut.pin.id}", pins)

    def _plated_pins(self, plates: Sequence[str]) -> Iterator[AssemblyStep]:
        """Pins that stand in some of the plates that turn."""
        for each in self.frame.standing:
            if each.seat in plates:
                pins = [f"{each.name} {at}" for at in range(1, 1 + len(each.spots))]
                text = f"Press the pins of '{each.name.removesuffix(' pin')}' into {each.seat}"
                if each.joined:
                    text = f"Press the {each.name} into {each.seat}, and into {each.wheel} when all between them stands"
                yield self._step(text, pins)

    def _on_eccentrics(self, names: Sequence[str]) -> Iterator[AssemblyStep]:
        """What turns on some eccentrics, of which it may need others that stand already."""
        every = self.plan.stack.eccentrics
        for each in (each for each in every if each.name in names):
            own = [other.name for other in every if other.wheels == each.wheels]
            if each.name == own[-1]:
                washers = [f"{name} washer {at}" for name in own for at in (1, 2)]
                text = f"Put {', '.join(each.wheels)} on {', '.join(own)}, to turn there between washers"
                if each.wave is not None:
                    text = f"Bend {', '.join(each.wheels)}, of one piece with its cup, over {each.name}"
                yield self._step(text, [*each.wheels, *washers])

    def _carried(self) -> Iterator[AssemblyStep]:
        """Studs of carriers with what turns on them, the nearest to the carrier first."""
        for seat in self.plan.choice.seats:
            own = {
                label: column
                for label, column in self.plan.carried.items()
                if self.plan.stack.carried[label].carrier == seat.link and self.plan.seat_of(seat.link) == seat.seat
            }
            feet = [label for label, column in own.items() if column.is_stud and not column.on]
            for label in feet:
                steps = [other for other, column in own.items() if column.on == label]
                both = " and ".join([label, *steps])
                text = f"Press the stud of {both} into {seat.seat}, its pipes on it" + (
                    f": first that of {label}, then that of {steps[0]}" if steps else ""
                )
                yield self._step(text, [f"{axis} stud" for axis in (label, *steps)])

    def _bridge(self) -> Iterator[AssemblyStep]:
        bridged = [each for each in self.plan.columns if each.bearing is AxisBearing.BRIDGE and each.members]
        if self.plan.bridge is None:
            return
        links, pillars = [each.members[0].link for each in bridged], len(self.frame.bridge_pillars)
        rods = [name for link in links for name in (f"{link} arbor", f"{link} lower collar", f"{link} upper collar")]
        text = (
            f"Put the arbors of {', '.join(links)} into the bridge between their collars, and the bridge on its pillars"
        )
        names = [f"{self.plan.stack.frame} bridge", *(f"bridge pillar {k}" for k in range(1, pillars + 1)), *rods]
        yield self._step(text, names)

    def _studs(self, bearing: AxisBearing, side: str) -> Iterator[AssemblyStep]:
        studs = [column.axis for column in self.plan.columns if column.bearing is bearing]
        if studs:
            text = f"Put the pipes on the studs of {', '.join(studs)} and press the studs into the {side} plate"
            yield self._step(text, [f"{axis} stud" for axis in studs])

    def _through(self) -> Iterator[AssemblyStep]:
        through = sorted(
            (each for each in self.plan.columns if each.bearing is AxisBearing.THROUGH and each.members),
            key=lambda column: min((disc.low for each in column.members for disc in each.discs), default=0.0),
        )
        if through:
            names = ", ".join(f"{each.axis} (pivot {each.pivot:g})" for each in through)
            links = [each.members[0].link for each in through]
            collars = [name for link in links for name in (f"{link} back collar", f"{link} front collar")]
            arbors = [f"{link} arbor" for link in links]
            yield self._step(
                f"Stand the arbors in the {self.low} plate, lowest wheels first: {names}", [*arbors, *collars]
            )


def _with(wheels: Sequence[str], spacers: Sequence[str], collets: Sequence[str]) -> str:
    """In words, what goes on with the wheels."""
    words = "" if not spacers else ", with the spacer between them" if len(spacers) == 1 else ", with their spacers"
    if collets:
        alone = [name.removeprefix("collet of ") for name in collets]
        words += (
            f", {'' if alone == [*wheels] else ', '.join(alone) + ' '}against {'its' if len(alone) == 1 else 'their'}"
        )
        words += " collet" if len(alone) == 1 else " collets"
    return words
