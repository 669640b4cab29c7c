"""The sizes of the triangular teeth of a train: as declared, best for each pair by itself, and best for the train."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import degrees
from typing import Any

from geartrain.numerics.results import Key, Pictured, Result, Tabular
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.triangular.triangular_form import Triangular
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh
from geartrain.workshop.sizes.outline_agreement import OutlineAgreement
from geartrain.workshop.sizes.size_design import SizeLimit, ToothSizes, size_columns
from geartrain.workshop.sizes.size_search import Range

DIGITS = 6
"""Decimals of radii and windows in a declaration: the figures told are of these."""


@dataclass(frozen=True)
class PairSizes(Result):
    """One pair of a train, its sizes as declared, best by itself, and best in the train.

    Attributes
    ----------
    name : str
        The pair.
    driver : str
        The wheel that drives.
    before, apart, together : ToothSizes
        As declared; best for the pair by itself; best for the train.
    runs : bool
        Whether the pair turns as declared.
    outlines : OutlineAgreement
        What the contact of the drawn outlines says of the last.

    See Also
    --------
    find_train_sizes : finds them.
    """

    KEYS = ("name", "driver", "teeth", Key("before", "declared"), "apart", "together", "outlines")

    name: str
    driver: str
    before: ToothSizes
    apart: ToothSizes
    together: ToothSizes
    runs: bool
    outlines: OutlineAgreement

    @property
    def teeth(self) -> tuple[int, int]:
        """Of the first and the second wheel that the pair names."""
        return self.before.teeth

    @property
    def declared(self) -> ToothSizes | None:
        """As declared; None where the pair does not turn so."""
        return self.before if self.runs else None


@dataclass(frozen=True)
class BestTrainSizes(Tabular, Pictured, Result):
    """The sizes of the triangular teeth with which a train is best, and what they gain.

    Attributes
    ----------
    train : str
        Its name.
    aim, output, source : str
        What was asked for; the link or output, and the link at which power enters.
    free : mapping of str to tuple of float
        Bounds of the free parameters; angles in rad.
    limits : tuple of SizeLimit
        What each pair has to keep.
    before, apart, together : float or None
        The figure of the train as declared (None where it does not run), with each pair best by itself, and with all
        together: loss; error peak to peak [rad]; the sum of impacts; the least margin [module].
    pairs : tuple of PairSizes
        The pairs that act on the output.
    untouched : mapping of str to str
        Pairs with real teeth that stay as they are, and why.
    declaration : mapping
        A train that extends the one given, with the sizes best together.

    See Also
    --------
    find_train_sizes : an example.
    """

    FIGURE = "train_sizes_figure"
    DRAWN_IN = "workshop"

    KEYS = (
        *("train", "aim", "output", "source", "free", "limits", "before", "apart", "together", "pairs"),
        *("untouched", "declaration"),
    )

    train: str
    aim: str
    output: str
    source: str
    free: Mapping[str, Range]
    limits: tuple[SizeLimit, ...]
    before: float | None
    apart: float
    together: float
    pairs: tuple[PairSizes, ...]
    untouched: Mapping[str, str]
    declaration: Mapping[str, Any]

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """By pair, a row for its sizes as declared (if it turns so), best by itself, and best for the train."""
        rows = [
            (pair.name, name, sizes)
            for pair in self.pairs
            for name, sizes in (("declared", pair.declared), ("by itself", pair.apart), ("together", pair.together))
            if sizes is not None
        ]
        told = {"pair": [pair for pair, _, _ in rows], "design": [name for _, name, _ in rows]}
        return {**told, **size_columns([sizes for _, _, sizes in rows])}


def form_data(sizes: ToothSizes, exact: bool = False) -> dict[str, Any]:
    """Sizes as a declaration says them; `exact`: with all digits of a float."""
    angles, lengths = ("", "") if exact else (".10g", f".{DIGITS}f")
    first, second = (f"{degrees(angle):{angles}} deg" for angle in sizes.half_angles)
    return {
        "form": "triangular",
        "half_angle": first if first == second else [first, second],
        "window": f"{sizes.window:{lengths}}",
        "radii": f"{sizes.radii:{lengths}}",
    }


# The triangular teeth of a train as designs: which pairs can be sized, what is declared of them, and back.


def sizeable_meshes(meshes: Iterable[GearMesh]) -> dict[str, TriangularMesh]:
    """The pairs with triangular teeth whose sizes are not declared as lengths, by name."""
    found = (mesh for mesh in meshes if isinstance(mesh, TriangularMesh))
    return {mesh.name: mesh for mesh in found if not mesh.tooth_form.has_lengths}


def as_form(sizes: ToothSizes) -> Triangular:
    """A design as the form of a pair."""
    return Triangular.declared(form_data(sizes))


def rounded(sizes: ToothSizes) -> ToothSizes:
    """With the digits that a declaration has."""
    return sizes.at({"radii": round(sizes.radii, DIGITS), "window": round(sizes.window, DIGITS)})


def declared_sizes(mesh: TriangularMesh) -> ToothSizes:
    """The sizes of a pair as declared: the first wheel of the pair first; in mid window where it does not turn."""
    sizes, window = mesh.law.sizes, mesh.window
    driver = 1 + mesh.gear.pair.index(mesh.driver)
    if driver == 2:
        sizes = sizes.swapped()
    place = 0.5
    if window and mesh.verdict.kind == "runs":
        place = min(max((sizes.excess - window.jam) / (window.run - window.jam), 0.0), 1.0)
    radii = sizes.R2 / sizes.R1 * sizes.z1 / sizes.z2
    # friction by a law of speed is searched under with its mean coefficient at the speed of the pair
    friction = mesh.losses.friction if mesh.verdict else mesh.law.friction
    return ToothSizes((sizes.z1, sizes.z2), radii, place, sizes.half_angles, friction, driver, sizes.ring)
