"""Write docs/ready-to-cut.md: the verdict of `geartrain export` on eighteen shipped trains; five folders measured.

`python docs/scripts/make_ready_to_cut.py --measure` exports them anew and keeps what is found in
docs/data/ready-to-cut.json (some minutes); without it the page is written from what is kept.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

from studies.page import paragraphs

DOCS = Path(__file__).resolve().parents[1]
PAGE, DATA = DOCS / "ready-to-cut.md", DOCS / "data" / "ready-to-cut.json"
TRAINS = {
    "Clocks and mills": ("longcase-clock-cycloidal", "longcase-clock-bs978", "watch-going-train", "lantern-mill"),
    "Antikythera": ("price-1974", "voulgaris-2024-a", "freeth-2008", "freeth-2021"),
    "Gearboxes": ("planetary-24-18-60", "ravigneaux-set", "wolfrom-175", "nrel-grc-750"),
    "Bevels": ("bevel-differential", "humpage", "south-pointing-chariot"),
    "Reducers": ("cycloidal-reducer", "rv-reducer", "strain-wave"),
}
ASSEMBLED = ("longcase-clock-cycloidal", "watch-going-train", "pennestri-2002", "freeth-2008", "wolfrom-175")
SHOWN = 12  # obstacles of a train on the page

SEEN = {
    "lantern-mill": """
Seen in the pictures of its steps: one spur wheel stands between two lanterns of 15 and 20 staves, and a tooth that is
right for the one is not for the other. Millwrights gave both stones the same lantern.
""",
    "freeth-2021": """
Seen in the pictures of its steps: the fixed wheels 49, 51 and 56 stand on a fixed pipe round the Moon's arbor, from a
plate of the frame through the tube of b; before them b goes out to its dial by an arm, which a bar beside the axis
joins to b1, as the published design joins b0. Slots of the followers are bars that turn through the room of other
wheels, and arbors on b1 pass through wheels of others where levels are found for all; what is drawn so cannot be put
together.
""",
}
"""What a person found in the pictures, by train."""

HEAD = """# Ready to cut, or not

Written by

    python docs/scripts/make_ready_to_cut.py --measure

Eighteen trains, as `geartrain export TRAIN --to FOLDER` writes them without further options, and what their proof says
([how](export.md#proved-before-it-is-cut)).
"""

TABLE = """
"Meshes" are pairs of flat wheels, turned against each other on the outlines that were read back; {meshes} in all. Play
is the least of any of them along the pitch circle, room the least distance of a tip from its mate's root. "Parts" are
the solids, held against each other in eight poses. Seconds are processor time of the whole command.
"""

FOLDERS = """
The folders of five were read by programs that know nothing of geartrain: trimesh reads `assembly.stl`, whose parts
`assembly.glb` names, manifold3d finds volumes, sections across the axes are cut and circles measured on their corners.
A round hole has its corners outside its circle, so that every chord leaves the stated room: that is why holes are up to
0.004 mm wider than stated. "Turning" are holes with something of another link in them, "aside" says how far apart the
middles of hole and rod are, "overlap" is the greatest volume that two parts share, over that of the smaller one.
"""


def measure() -> dict[str, Any]:
    """All trains, and the folders of some."""
    trains = [_proved(name, kind) for kind, names in TRAINS.items() for name in names]
    return {"trains": trains, "folders": [_assembled(name) for name in ASSEMBLED]}


def _proved(name: str, kind: str) -> dict[str, Any]:
    """The proof of a train, and how long the whole of it took."""
    import geartrain
    from geartrain.scene import ManufacturingSizes, SolidModel
    from geartrain.workshop import export_files
    from geartrain.workshop.export.file_set import KINDS, installed
    from geartrain.workshop.export.proof import prove_train

    start = process_time()
    train = geartrain.load(name)
    work = SolidModel(train, ManufacturingSizes(), train.declaration.state_or_first(None))
    proof = prove_train(work)
    proved = process_time()
    kinds, _ = installed(list(KINDS))
    files = export_files(work, kinds, None, proof)
    for each in files:
        each.make()
    ended = process_time()
    print(f"{name}: {proof.verdict}, {ended - start:.1f} s", flush=True)
    return {
        "train": name,
        "kind": kind,
        "ready": proof.is_ready,
        "obstacles": [each.problem.text for each in proof.findings if each.is_error],
        "notes": [each.problem.text for each in proof.findings if not each.is_error],
        "meshes": [
            {"pair": mesh.pair, "declared": mesh.declared, "minimum": mesh.minimum, "overlap": mesh.overlap}
            | {"clearance": mesh.clearance, "tip_width": mesh.tip_width}
            for mesh in proof.meshes
        ],
        "parts": len(work.parts),
        "files": len(files),
        "seconds": {"proof": round(proved - start, 1), "all": round(ended - start, 1)},
    }


def _assembled(name: str) -> dict[str, Any]:
    """The folder of a train, written by the command and read by strangers."""
    from studies.assembled_folder import find_fits, find_overlaps, read_parts
    from typer.testing import CliRunner

    from geartrain.cli import app

    with TemporaryDirectory() as parent:
        folder = Path(parent) / name
        CliRunner().invoke(app, ["export", name, "--to", str(folder), "--as", "stl,glb"])
        parts = read_parts(folder)
    overlaps, fits = find_overlaps(parts), find_fits(parts)
    turning = [fit for fit in fits if not fit.joined]
    print(f"{name}: {len(parts)} parts read", flush=True)
    return {
        "train": name,
        "parts": len(parts),
        "closed": sum(bool(part.mesh.is_watertight) for part in parts),
        "volume": sum(float(part.mesh.volume) for part in parts),
        "overlaps": [vars(each) for each in overlaps[:3]],
        "turning": _span(turning),
        "pipes": _span([fit for fit in turning if fit.hole_of.endswith("pipe")]),
        "joined": _span([fit for fit in fits if fit.joined]),
        "aside": max((fit.aside for fit in fits), default=0.0),
    }


def _span(fits: Sequence[Any]) -> dict[str, Any]:
    """How many, and the least and the greatest clearance (mm)."""
    gaps = [fit.clearance for fit in fits]
    return {"count": len(gaps), "minimum": min(gaps, default=0.0), "most": max(gaps, default=0.0)}


def page(kept: Mapping[str, Any]) -> Iterator[str]:
    """The page, line by line."""
    trains = kept["trains"]
    yield HEAD
    yield paragraphs(TABLE, meshes=sum(len(each["meshes"]) for each in trains))
    yield "| train | verdict | meshes | least play mm | least room mm | parts | proof s | all s |"
    yield "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |"
    for kind in TRAINS:
        yield f"| **{kind}** | | | | | | | |"
        yield from (_row(each) for each in trains if each["kind"] == kind)
    for each in trains:
        if each["obstacles"]:
            yield from ("", f"## In the way of {each['train']}", "")
            if seen := SEEN.get(each["train"]):
                yield paragraphs(seen)
            yield from (f"- {text}" for text in each["obstacles"][:SHOWN])
            if (more := len(each["obstacles"]) - SHOWN) > 0:
                yield f"- and {more} more"
    yield from ("", "## Five folders, read by other programs", "", paragraphs(FOLDERS))
    yield "Clearances are in mm: of so many holes the least and the greatest."
    yield ""
    yield "| train | parts | closed | turning | pipes | joined | aside mm | overlap |"
    yield "| --- | ---: | ---: | --- | --- | --- | ---: | --- |"
    yield from (_folder_row(each) for each in kept["folders"])
    yield ""


def _row(found: Mapping[str, Any]) -> str:
    meshes, seconds = found["meshes"], found["seconds"]
    many = len(found["obstacles"])
    verdict = "ready to cut" if found["ready"] else f"{many} thing{'s' if many > 1 else ''} in the way"
    minimum = min(meshes, key=lambda mesh: mesh["minimum"], default=None)
    backlash = "-" if minimum is None else f"{minimum['least']:.4f} ({minimum['pair']})"
    room = min((mesh["clearance"] for mesh in meshes), default=None)
    cells = found["train"], verdict, len(meshes), backlash, "-" if room is None else f"{room:.3f}", found["parts"]
    return f"| {' | '.join(map(str, cells))} | {seconds['proof']:.0f} | {seconds['all']:.0f} |"


def _folder_row(found: Mapping[str, Any]) -> str:
    spans = [
        f"{span['count']}: {span['least']:.4f} to {span['most']:.4f}" if span["count"] else "none"
        for span in (found["turning"], found["pipes"], found["joined"])
    ]
    worst = found["overlaps"][0] if found["overlaps"] else None
    overlap = "none" if worst is None else f"{worst['share']:.1g} of {worst['one']} or {worst['other']}"
    cells = found["train"], found["parts"], found["closed"], *spans, f"{found['aside']:.0e}", overlap
    return f"| {' | '.join(map(str, cells))} |"


def main() -> None:
    """Read what is kept, write the page."""
    PAGE.write_text("\n".join(page(json.loads(DATA.read_text(encoding="utf-8")))), encoding="utf-8")
    print("wrote docs/ready-to-cut.md")


def from_command_line() -> None:
    """Write the page; with `--measure` after its run was made anew."""
    requested = argparse.ArgumentParser(description="Write docs/ready-to-cut.md from its kept run.")
    requested.add_argument("--measure", action="store_true", help="export all trains anew, which takes minutes")
    if requested.parse_args().measure:
        DATA.write_text(json.dumps(measure(), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    main()


if __name__ == "__main__":
    from_command_line()
