"""Assembly instructions of an exported folder: README, assembly steps in order of height, and their pictures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from html import escape
from itertools import pairwise
from math import degrees
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, install_command, printable
from geartrain.kinematics.buildability import BuildFinding
from geartrain.numerics.results import Shown
from geartrain.report.text import markdown_text
from geartrain.scene.palette import THEMES, series_colour
from geartrain.scene.parts.arbor_columns import SHAKE, AxisBearing, AxisColumn
from geartrain.scene.parts.turned_parts import rod_name
from geartrain.workshop.export.label_boxes import LabelBoxes
from geartrain.workshop.export.parts_list import ListedPart, parts_list
from geartrain.workshop.export.proof.mesh_proof import ALLOWED, MeshProof
from geartrain.workshop.export.proof.train_proof import TrainProof
from geartrain.workshop.export.proof.turned_pair import NOTHING, TOLERANCE

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.parts.frame_plates import FramePlates
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.scene.solids.solid_part import SolidPart


_GROUPS = "Errors:", "Not among the files, to be made by hand:", "Notes:"
_BY_HAND = "W3", "S1"  # rules of notes that a wheel has no drawing, or an axis no bearing
_HEADER = (
    "| mesh | declared backlash | minimum backlash | overlap mm2 | contact ratio | clearance | tip width | verdict |"
)
_CHORD = 0.1  # mm: maximum deviation of drawn chords from an outline
_GAP = 0.12  # distance between the two views, as a fraction of the width
_MARGIN = 0.04  # as a fraction of the width
_WIDE = 720  # pixels
_LETTER = 0.016  # height of letters, as a fraction of the width
_MOST_NAMED = 14  # parts that are labelled in a picture: more labels would overlap
_PAPER = THEMES["light"]
_NEW, _OLD = (series_colour(0), _PAPER.band), (_PAPER.line, "none")  # edge and face


def unproved() -> str:
    """Return the sentence of the README which states that the parts were not checked, because packages are missing."""
    return (
        "**Not proved**: the parts were not turned, because shapely and manifold3d are not installed: "
        f"`{install_command('proof')}`."
    )


def readme(
    work: SolidModel,
    files: Sequence[tuple[str, str]],
    missing: Sequence[Problem],
    parts: bool,
    proof: TrainProof | None = None,
) -> str:
    """Return the text of the README of an exported folder.

    files     paths and descriptions of the files
    missing   problems with parts that could not be made
    parts     True if some of the files show parts
    proof     proof of the train; None if nothing was proved
    """
    declared = work.train.declaration
    lines = [f"# {_cell(declared.name)}", "", *([_cell(declared.title), ""] if declared.title else [])]
    if proof is not None:
        lines += _verdict_lines(proof)
    elif parts:
        lines += [unproved(), ""]
    lines += [
        "Lengths are in mm, and drawings are 1:1. Cut the layer CUT and engrave the layer ENGRAVE. The layer PITCH is",
        "for reference.",
        "",
    ]
    lines += ["| file | content |", "| --- | --- |"]
    pictures = any(path == picture_path(1) for path, _ in files)
    lines += [f"| {path} | {_cell(title)} |" for path, title in files if not path.startswith("assembly/")]
    if pictures:
        lines.append("| assembly/ | one picture for each step of the assembly |")
    if proof is not None:
        lines += _proof_lines(proof)
    if parts:
        if work.blanks.backlashes:
            lines += ["", "## Backlash of the teeth as cut, along the pitch circles", ""]
        for each in work.blanks.backlashes:
            turned = zip(each.wheels, each.angles, strict=True)
            angles = ", ".join(f"{degrees(angle):.4g}° of {wheel}" for wheel, angle in turned)
            jams = "; the pair jams" if each.length < 0 else ""
            lines.append(f"- {_cell(each.pair)}: {each.length:.4g} mm, {_cell(angles + jams)}")
        lines += _parts(parts_list(work))
        if work.frame is not None:
            lines += ["", "## Fits", "", *_fits(work), "", "## Assembly", ""]
            for number, step in enumerate(assembly_steps(work), 1):
                picture = f" ([picture]({picture_path(number)}))" if pictures and step.parts and step.shown else ""
                lines.append(f"{number}. {_cell(step.text)}{picture}")
    reported = set() if proof is None else {found.problem for found in proof.findings}
    if left := [each for each in missing if each not in reported]:
        lines += ["", "## Parts that could not be made", ""]
        lines += [f"- {_cell(each.text)}" for each in left]
    return "\n".join([*lines, ""])


def _parts(rows: Sequence[ListedPart]) -> Iterator[str]:
    yield from ("", "## Parts", "", "| part | count | kind | material | size mm | mass of one g | fits |")
    yield "| --- | ---: | --- | --- | --- | ---: | --- |"
    for row in rows:
        cells = ", ".join(row.names), str(row.count), row.kind, row.material, row.size, f"{row.mass:.4g}", row.fits
        yield f"| {' | '.join(map(_cell, cells))} |"
    yield ""
    yield f"Total mass: {sum(row.count * row.mass for row in rows):.4g} g, with densities from handbooks."


def _fits(work: SolidModel) -> Iterator[str]:
    process = work.process
    yield f"Process: {process.name}. Bearing holes are {process.running:g} mm wider than their pivots. Wheels on arbors"
    yield f"are {process.joint} (hole {process.press:+g} mm). An arbor between plates has {SHAKE:g} mm of end shake."
    kerf = f"are compensated for a kerf of {process.kerf:g} mm" if process.kerf else "have the finished size"
    yield f"Outlines in drawings {kerf}. These are typical values: cut a test piece first."


def _cell(text: str) -> str:
    return printable(markdown_text(text).replace("|", "\\|").replace("\n", " "))


# ------------------------------------------------------------------------------------------------ findings of the proof


def _verdict_lines(proof: TrainProof) -> list[str]:
    """Return the lines of the README with the verdict and all findings of the proof."""
    lines = [f"**{'Ready to cut.' if proof.is_ready else 'Not ready to cut.'}**", ""]
    groups: dict[str, list[BuildFinding]] = {}
    for found in proof.findings:
        group = 0 if found.is_error else 1 if found.rule in _BY_HAND else 2
        groups.setdefault(_GROUPS[group], []).append(found)
    for title in _GROUPS:
        lines += [title, "", *(f"- {_cell(found.text)}" for found in groups[title]), ""] if title in groups else []
    return lines


def _proof_lines(proof: TrainProof) -> list[str]:
    """Return the lines of the README with the measured values and the method of the proof."""
    lines = ["", "## Proof on the written outlines", ""]
    lines += [
        f"The drawings were read back, with arcs as chords within {TOLERANCE:g} mm, and the wheels of every mesh were",
        f"turned through a pitch. An overlap above {NOTHING:g} mm2 is an error. The backlash may be {ALLOWED:g} mm",
        "below the declared one. Lengths are in mm.",
        "",
        _HEADER,
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |",
        *map(_row, proof.meshes),
    ]
    if proof.links:
        lines += ["", "While the input is held, each link can turn by this angle:", ""]
        lines += ["| link | degrees |", "| --- | ---: |"]
        for each in proof.links:
            turn = "free" if each.backlash is None else f"{degrees(max(each.backlash, 0.0)):.3g}"
            lines.append(f"| {_cell(each.link)} | {turn} |")
    return lines


def _row(mesh: MeshProof) -> str:
    ratio = "-" if mesh.contact_ratio is None else f"{mesh.contact_ratio:.3f}"
    errors = [found.rule for found in mesh.findings if found.is_error]
    words = " ".join(errors) if errors else "turns"
    values = (_cell(mesh.pair), f"{mesh.declared:.4f}", f"{mesh.minimum:.4f}", f"{mesh.overlap:.2g}", ratio)
    return f"| {' | '.join(values)} | {mesh.clearance:.3f} | {mesh.tip_width:.3f} | {words} |"


# ---------------------------------------------------------------------------------------------------------------- steps


@dataclass(frozen=True, slots=True)
class AssemblyStep(Shown):
    """One step in the assembly of a train."""

    text: str
    """Instruction of the step."""
    parts: tuple[str, ...]
    """Names of the parts that are added in this step."""
    shown: bool = True
    """True if a picture of the step is drawn; False for hanging parts, which are too tall for a picture."""


def assembly_steps(work: SolidModel) -> list[AssemblyStep]:
    """Return the assembly steps of a train: arbors, parts on carriers, back plate, studs, front plate, dials."""
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
            posts = [post.name for post in self.frame.posts if plate.ring and post.name == f"{plate.ring} drum"]
            tail = ", with the ring on its drum" if plate.ring else ""
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
            f"Guide all upper pivots into the {self.high} plate, press it on the pillars, and check the end shake of "
            "each arbor",
            [f"{base} {self.high} plate"],
        )
        yield from self._bridge()
        yield from self._cross_parts()
        if self.work.dials:
            names = [dial.name for dial in self.work.dials]
            feet = [foot.name for dial in self.work.dials for foot in dial.feet]
            yield self._step(
                f"Press the feet into {', '.join(names)} and into the plate behind each dial, and put the hands on the "
                "arbors; on a common axis, begin with the outermost pipe",
                [*names, *feet],
            )
        if "pendulum cock" in self.known:
            yield self._step("Press the cock of the pendulum into its plate", ["pendulum cock"])
            yield replace(self._step("Hang the pendulum on its cock", ["pendulum rod", "pendulum bob"]), shown=False)
        if "weight" in self.known:
            yield replace(self._step("Hang the weight on a line around its barrel", ["weight"]), shown=False)
        yield AssemblyStep("Before oiling, turn the driving link until the slowest wheel has turned once", ())

    def _cross_parts(self) -> Iterator[AssemblyStep]:
        """Yield the steps that mount arms with pins, cages of carriers, and brackets of cross arbors."""
        arms = sorted(name for name in self.known if name.endswith(" pin arm"))
        cages = [part.name for cage in self.work.cages for part in cage.parts]
        brackets = [bracket.part.name for bracket in self.work.brackets]
        for names, text in (
            (arms, "Fix the arms to the arbors of their links, pins outwards"),
            (cages, "Fix the posts of the cages to their carriers, and put the cross arbors into their eyes"),
            (brackets, "Screw the brackets to the plates, with the arbors between them"),
        ):
            if names:
                yield self._step(text, names)

    def _step(self, text: str, parts: Sequence[str]) -> AssemblyStep:
        return AssemblyStep(text, tuple(name for name in parts if name in self.known))

    def _column(self, column: AxisColumn) -> Iterator[AssemblyStep]:
        """Yield the steps that mount wheels on arbors or pipes, and slide pipes over each other."""
        for member in column.members:
            every = [disc.name for disc in sorted(member.discs, key=lambda disc: disc.low)]
            wheels = [name for name in every if name not in self.plan.cut]
            what = "pipe" if member.inner else "arbor"
            # an arbor or pipe without wheels is fitted in a later step
            if wheels:
                order = ", from below in this order" if len(wheels) > 1 else ""
                barrel = self.frame.barrel
                sleeves = [f"spacer {low} to {high}" for low, high in pairwise(every)]
                sleeves += [f"collet of {name}" for name in every]
                if barrel is not None and barrel.wheel in every:
                    sleeves.append(barrel.part.name)
                named = ", ".join(name for name in sleeves if name in self.known)
                text = f"Fix {', '.join(wheels)} on the {what} of '{member.link}'{order}"
                text += f", with {named}" if named else ""
                yield self._step(text, [rod_name(column, member), *every, *sleeves])
                yield from self._on_eccentrics(every)
                yield from self._plate_pins(every)
        # pipes on a stud slide on this stud, which is fitted in a later step
        pipes = [member for member in column.members if member.inner]
        if pipes and not column.is_stud:
            links = ", ".join(member.link for member in pipes)
            text = f"Slide the pipes on axis {column.axis}, innermost first: {links}"
            yield self._step(text, [rod_name(column, member) for member in pipes])

    def _pins(self) -> Iterator[AssemblyStep]:
        for name, cut in self.work.cut_couplings.items():
            if cut.pin is None:
                continue
            pins = [f"{name} pin {at + 1}" for at in range(len(cut.coupling.pins_at))] or [f"{name} pin"]
            yield self._step(f"Press the pin{'s'[: len(pins) - 1]} of '{name}' into {cut.pin.id}", pins)

    def _plate_pins(self, plates: Sequence[str]) -> Iterator[AssemblyStep]:
        """Yield the steps that press pins into turning plates."""
        for each in self.frame.standing:
            if each.seat in plates:
                pins = [f"{each.name} {at}" for at in range(1, 1 + len(each.spots))]
                text = f"Press the pins of '{each.name.removesuffix(' pin')}' into {each.seat}"
                if each.joined:
                    text = f"Press the {each.name} into {each.seat}, and into {each.wheel} once all between is in place"
                yield self._step(text, pins)

    def _on_eccentrics(self, names: Sequence[str]) -> Iterator[AssemblyStep]:
        """Yield the steps that mount wheels on the given eccentrics."""
        every = self.plan.stack.eccentrics
        for each in (each for each in every if each.name in names):
            own = [other.name for other in every if other.wheels == each.wheels]
            if each.name == own[-1]:
                washers = [f"{name} washer {at}" for name in own for at in (1, 2)]
                text = f"Put {', '.join(each.wheels)} on {', '.join(own)} between washers, free to turn"
                if each.wave is not None:
                    text = f"Bend {', '.join(each.wheels)}, which is one piece with its cup, over {each.name}"
                yield self._step(text, [*each.wheels, *washers])

    def _carried(self) -> Iterator[AssemblyStep]:
        """Yield the steps that press the studs of planets, with their wheels and pipes, into carriers."""
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
                text = f"Press the stud of {both} into {seat.seat}, with its pipes on it" + (
                    f": first {label}, then {steps[0]}" if steps else ""
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
            text = f"Put the pipes on the studs of {', '.join(studs)}, and press the studs into the {side} plate"
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
                f"Put the arbors into the {self.low} plate, lowest wheels first: {names}", [*arbors, *collars]
            )


# ----------------------------------------------------- pictures: a step from above and from the side, with new parts


def picture_path(number: int) -> str:
    """Return the path of the picture of an assembly step, relative to the exported folder."""
    return f"assembly/{number:02d}.svg"


def step_pictures(work: SolidModel) -> Iterator[tuple[str, str, Callable[[], bytes]]]:
    """Yield path, title and drawing function of one picture for each assembly step that adds parts."""
    steps = assembly_steps(work)
    pictures = AssemblyPictures(work, steps) if steps else None
    before: dict[str, None] = {}
    for number, step in enumerate(steps, 1):
        if pictures is not None and step.parts and step.shown:
            draw = partial(pictures.draw, step, number, tuple(before))
            yield picture_path(number), f"step {number} of the assembly", draw
        before |= dict.fromkeys(step.parts)


class AssemblyPictures:
    """Pictures of the assembly steps of one train, in the coordinate system of the stacked parts [mm]."""

    def __init__(self, work: SolidModel, steps: Sequence[AssemblyStep]) -> None:
        assert work.frame is not None
        self.stack = work.frame.plan.stack
        shown = {name for step in steps if step.shown for name in step.parts}
        self.parts = {part.name: part for part in work.parts if part.name in shown}

    @cached_property
    def boxes(self) -> dict[str, Floats]:
        """Minimum and maximum of x (rightwards), y (upwards) and height of each part [mm], shape (2, 3)."""
        found = {}
        for name, part in self.parts.items():
            seen = part.placed.vertices @ self.stack.turn
            found[name] = np.array([seen.min(axis=0), seen.max(axis=0)])
        return found

    @cached_property
    def extent(self) -> tuple[Floats, Floats]:
        """Minimum and maximum coordinates over all parts [mm]."""
        boxes = np.array(list(self.boxes.values()))
        return boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)

    def draw(self, step: AssemblyStep, number: int, before: Sequence[str]) -> bytes:
        """Return the picture of one assembly step as an SVG file. It also shows the parts of earlier steps."""
        low, high = self.extent
        wide, deep, tall = (high - low).tolist()
        gap, margin = _GAP * wide, _MARGIN * wide
        letter = _LETTER * wide
        width, height = wide + 2 * margin, deep + gap + tall + 2 * margin + 3 * letter
        lines = [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{_WIDE}" height="{_WIDE * height / width:.0f}" '
            f'viewBox="0 0 {width:.3f} {height:.3f}">',
            f"<title>{number}. {escape(step.text)}</title>",
            f'<rect width="{width:.3f}" height="{height:.3f}" fill="{_PAPER.paper}"/>',
            f'<g fill="{_PAPER.ink}" font-family="sans-serif" font-size="{letter:.3f}">',
        ]
        corner = np.array([margin, margin + 2 * letter])
        there = (name for name in before if name in self.parts and name not in step.parts)
        shown = [(name, _OLD) for name in there] + [(name, _NEW) for name in step.parts]
        # lines as thin as about one pixel
        stroke = wide / 700
        for name, (edge, fill) in shown:
            part = self.parts[name]
            style = f'stroke="{edge}" fill="{fill}" stroke-width="{stroke:.3f}" fill-opacity="0.35" fill-rule="evenodd"'
            lines.append(f'<path d="{" ".join(self._plan(part, corner, name in step.parts))}" {style}/>')
            (x0, _, z0), (x1, _, z1) = (self.boxes[name] - low).tolist()
            y = corner[1] + deep + gap + tall - z1
            lines.append(
                f'<rect x="{x0 + margin:.3f}" y="{y:.3f}" width="{x1 - x0:.3f}" height="{z1 - z0:.3f}" {style}/>'
            )
        view = float(corner[1]) + deep + gap  # upper end of the view from the side
        labels = LabelBoxes((0.0, margin + letter, width, view - 2 * letter), letter)
        lines += self._names(step, labels, corner)
        lines.append(_label(f"Step {number}: from above", margin, margin + letter / 2))
        lines.append(_label("and from the side", margin, view - letter))
        return "\n".join([*lines, "</g></svg>", ""]).encode("utf-8")

    def _plan(self, part: SolidPart, corner: Floats, fine: bool) -> Iterator[str]:
        """Yield SVG paths of a part in the top view at `corner`; wheels are circles unless `fine` is True."""
        low, high = self.extent
        # round parts, and wheels of earlier steps, are drawn as circles
        radius = part.turned.diameter / 2 if part.turned is not None else 0.0
        if part.kind == "wheel" and part.contours and not fine:
            radius = float(np.hypot(*part.contours[0].points.T).max())
        if radius:
            x, y, _ = (part.place @ self.stack.turn).tolist()
            x, y = corner[0] + x - low[0] - radius, corner[1] + high[1] - y
            half = f"a {radius:.3f} {radius:.3f} 0 1 0"
            yield f"M {x:.3f} {y:.3f} {half} {2 * radius:.3f} 0 {half} {-2 * radius:.3f} 0 Z"
            return
        for contour in part.contours:
            flat = contour.flattened(_CHORD)
            seen = (np.column_stack([flat, np.zeros(len(flat))]) @ part.turn.T + part.place) @ self.stack.turn
            yield _closed(corner[0] + seen[:, 0] - low[0], corner[1] + high[1] - seen[:, 1])
        if not part.contours:
            (x0, y0, _), (x1, y1, _) = self.boxes[part.name].tolist()
            x = corner[0] - low[0] + np.array([x0, x1, x1, x0])
            yield _closed(x, corner[1] + high[1] - np.array([y0, y0, y1, y1]))

    def _names(self, step: AssemblyStep, labels: LabelBoxes, corner: Floats) -> Iterator[str]:
        """Yield the SVG labels of new parts, if these are few. `corner` is the upper left corner of the view [mm]."""
        low, high = self.extent
        for name in step.parts if len(step.parts) <= _MOST_NAMED else ():
            x, y, _ = self.boxes[name].mean(axis=0)
            x, y = float(corner[0] + x - low[0]), float(corner[1] + high[1] - y)
            u, v = labels.place(name, x, y)
            if np.hypot(u - x, v - y) > labels.size:
                line = f"M {x:.3f} {y:.3f} L {u:.3f} {v:.3f}"
                yield f'<path d="{line}" fill="none" stroke="{_PAPER.quiet}" stroke-width="{labels.size / 20:.3f}"/>'
            yield _label(name, u, v, 'text-anchor="middle" dominant-baseline="central"')


def _label(text: str, x: float, y: float, style: str = "") -> str:
    return f'<text x="{x:.3f}" y="{y:.3f}" {style}>{escape(text)}</text>'


def _closed(x: Floats, y: Floats) -> str:
    points = " L ".join(f"{a:.3f} {b:.3f}" for a, b in zip(x.tolist(), y.tolist(), strict=True))
    return f"M {points} Z"
