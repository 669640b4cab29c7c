"""A gear pair as trials see it, whatever its teeth: how its wheels are drawn, judged, filed, and how it turns."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import gcd, inf, nan, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.workshop.cutting.cut_pair import CutGearPair
from geartrain.workshop.cutting.displaced_pair import DisplacedPair, even_play
from geartrain.workshop.cutting.file_strokes import FileableCutPair, FilingWork, file_to_fit
from geartrain.workshop.cutting.least_backlash import jamming_bound, nominal_backlash
from geartrain.workshop.cutting.meshing_verdicts import batch_verdicts
from geartrain.workshop.cutting.trial_transmission import (
    CutTrialTransmission,
    DisplacedTrialTransmission,
    TrialTransmissionFunction,
)
from geartrain.workshop.monte_carlo.random_streams import fitted

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geartrain.numerics.arrays import Ints
    from geartrain.teeth.conjugate.displaced_contact import DisplacedContact
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes
    from geartrain.workshop.cutting.declared_errors import ErrorSpecification
    from geartrain.workshop.cutting.meshing_cycle import MeshingVerdicts

_SPOILT = 0.125  # of a pitch: a flank filed beyond a quarter of its tooth's thickness


@dataclass(frozen=True, slots=True)
class TrialPair(ABC):
    """One gear pair: `first` drives, both wheels by number; `mirrored` where a wheel turns against its own numbering.

    even     mean error of the pair without cutting errors (rad of the driven wheel)
    fitting  errors of its axes, in depths of the less deep teeth
    stroke   what one stroke of the file takes, in the same depths; 0 where nothing is filed to fit
    """

    name: str
    first: int
    second: int
    mirrored: tuple[bool, bool]
    even: float
    fitting: Mapping[str, ErrorSpecification] = field(default_factory=dict, kw_only=True)
    stroke: float = field(default=0.0, kw_only=True)

    @property
    @abstractmethod
    def teeth(self) -> tuple[int, int]:
        """Tooth numbers of the driver and of the driven wheel."""

    @property
    @abstractmethod
    def depth(self) -> float:
        """Depth of the less deep teeth (in the unit of lengths of the wheels)."""

    @property
    @abstractmethod
    def play(self) -> float:
        """Nominal play, in pitches of the driven wheel."""

    @property
    @abstractmethod
    def question(self) -> tuple[float, ...]:
        """Its sizes, on which results hang."""

    @abstractmethod
    def cut(self, wheels: Sequence[Any], shift: Any) -> Any:
        """The pair of drawn wheels on its axles, these so much farther apart."""

    @abstractmethod
    def verdicts(self, pair: Any) -> MeshingVerdicts:
        """What becomes of each trial of a cut pair."""

    @abstractmethod
    def law(self, pair: Any, rows: Ints) -> TrialTransmissionFunction:
        """The transmission functions of a cut pair; `rows` says which trial is asked at each angle."""

    @abstractmethod
    def filed(self, pair: Any) -> FilingWork[Any]:
        """A cut pair filed to fit."""

    @abstractmethod
    def cleared(self, clearance: float) -> TrialPair:
        """The pair at another clearance."""

    def jamming_bound(self, sigma: float) -> float:
        """A bound on the probability of a jam by normal errors of placement (of a pitch); NaN where none is known."""
        del sigma
        return nan

    @property
    def pitches(self) -> tuple[float, float]:
        """Pitches of both wheels (rad)."""
        return 2 * pi / self.teeth[0], 2 * pi / self.teeth[1]

    @property
    def count(self) -> int:
        """Couples in a full cycle of teeth."""
        return self.teeth[0] * self.teeth[1] // gcd(*self.teeth)


@dataclass(frozen=True, slots=True)
class TriangularTrialPair(TrialPair):
    """Triangular teeth: exact for errors of any size."""

    sizes: TriangularSizes

    @property
    def teeth(self) -> tuple[int, int]:
        """Tooth numbers."""
        return self.sizes.z1, self.sizes.z2

    @property
    def depth(self) -> float:
        """Depth of the less deep teeth (as the radii)."""
        return min(self.sizes.depths)

    @property
    def play(self) -> float:
        """Nominal play, in pitches."""
        return nominal_backlash(self.sizes)

    @property
    def question(self) -> tuple[float, ...]:
        """Radii, half angles, distance."""
        sizes = self.sizes
        return *sizes.signed_radii, sizes.beta1, sizes.beta2, sizes.excess

    def cut(self, wheels: Sequence[Any], shift: Any) -> CutGearPair:
        """Wheels of outer radius 1 in the sizes of the pair."""
        sizes = self.sizes
        R1, R2 = sizes.signed_radii
        first = fitted(wheels[self.first], R1, sizes.beta1, self.mirrored[0])
        second = fitted(wheels[self.second], R2, sizes.beta2, self.mirrored[1])
        return CutGearPair(sizes, first, second, shift)

    def verdicts(self, pair: Any) -> MeshingVerdicts:
        """One trial where all share everything."""
        first = pair.first if pair.trials else replace(pair.first, place=pair.first.place[None])
        return batch_verdicts(pair.sizes, first, pair.second, pair.shift)

    def law(self, pair: Any, rows: Ints) -> TrialTransmissionFunction:
        """Tooth by tooth."""
        return CutTrialTransmission(pair, self.even, rows)

    def filed(self, pair: Any) -> FilingWork[Any]:
        """Those that jam are filed; the others are left as they are drawn."""
        count = pair.trials[0] if pair.trials else 1
        jams = np.flatnonzero(self.verdicts(pair).jams)
        strokes, teeth = np.zeros((2, count), np.int64)
        low = tuple(np.zeros((count, 2, z)) for z in self.teeth)
        if len(jams):
            whole = FileableCutPair(_each(pair, count))
            work = file_to_fit(whole.taken(jams), self.stroke * self.depth, _SPOILT * self.sizes.R2 * self.pitches[1])
            strokes[jams], teeth[jams] = work.strokes, work.teeth
            for own, filed in zip(low, work.low, strict=True):
                own[jams] = filed
            pair = whole.filed((low[0], low[1])).pair
        return FilingWork(pair, strokes, teeth, (low[0], low[1]))

    def jamming_bound(self, sigma: float) -> float:
        """2 lcm Q(play / 2 sigma)."""
        return jamming_bound(self.sizes, sigma)

    def cleared(self, clearance: float) -> TriangularTrialPair:
        """1 and the excess, which of an external pair is its clearance factor, or a share of the pair's own window."""
        return replace(self, sizes=self._cleared(clearance))

    def _cleared(self, clearance: float) -> TriangularSizes:
        if clearance >= 1:
            return self.sizes.at(clearance - 1)
        from geartrain.teeth.triangular.clearance_window import find_window

        window = find_window(self.sizes)
        if not window:
            what = f"pair '{self.name}' has no window of clearance"
            raise RangeError(Problem(what, "no clearance lets its even teeth turn", "give clearance factors above 1"))
        return self.sizes.at(window.at(clearance))


@dataclass(frozen=True, slots=True)
class DisplacedTrialPair(TrialPair):
    """Other teeth: displaced flanks along the contact of a couple, right to first order in the errors."""

    contact: DisplacedContact

    @property
    def teeth(self) -> tuple[int, int]:
        """Tooth numbers."""
        first, second = self.contact.wheels
        return first.z, second.z

    @property
    def depth(self) -> float:
        """Depth of the less deep teeth (modules; rad on cones)."""
        return min(each.depth for each in self.contact.wheels)

    @property
    def play(self) -> float:
        """Nominal play, in pitches."""
        return even_play(self.contact) / self.pitches[1]

    @property
    def question(self) -> tuple[float, ...]:
        """What the contact is made of, by a few of its numbers."""
        at = self.contact
        return at.start, at.end, float(at.normal[0]), float(at.normal[-1]), at.play, float(at.even[0])

    def cut(self, wheels: Sequence[Any], shift: Any) -> DisplacedPair:
        """Wheels as they turn in this pair."""
        pair = zip((self.first, self.second), self.mirrored, strict=True)
        first, second = (wheels[at].mirrored() if turned else wheels[at] for at, turned in pair)
        if not np.broadcast_shapes(first.trials, second.trials, np.shape(shift)):
            first = replace(first, place=first.place[None])
        return DisplacedPair(self.contact, first, second, shift)

    def verdicts(self, pair: Any) -> MeshingVerdicts:
        """What becomes of each trial."""
        found: MeshingVerdicts = pair.verdicts()
        return found

    def law(self, pair: Any, rows: Ints) -> TrialTransmissionFunction:
        """Of the foremost couple at each angle."""
        return DisplacedTrialTransmission(pair, self.even, rows)

    def filed(self, pair: Any) -> FilingWork[Any]:
        """By strokes of the length declared."""
        return file_to_fit(pair, self.stroke * self.depth, _SPOILT * self.contact.wheels[0].pitch)

    def cleared(self, clearance: float) -> DisplacedTrialPair:
        """A factor of the centre distance (1 and above)."""
        if clearance < 1 or not self.contact.distance < inf:
            what = f"pair '{self.name}' has no {'window of clearance' if clearance < 1 else 'centre distance'}"
            why = "shares of a window are of triangular teeth, factors of a centre distance of parallel axes"
            raise RangeError(
                Problem(what, why, "leave --clearance out, or give factors above 1 where axes are parallel")
            )
        return replace(self, contact=self.contact.apart_by((clearance - 1) * self.contact.distance))


def _each(pair: CutGearPair, count: int) -> CutGearPair:
    """The pair with an axis of trials on both wheels."""
    wheels = [
        replace(wheel, place=np.broadcast_to(wheel.place, (count, wheel.z))) for wheel in (pair.first, pair.second)
    ]
    return CutGearPair(pair.sizes, wheels[0], wheels[1], pair.shift)
