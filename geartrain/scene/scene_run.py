"""A train's simulated motion as a page carries it: angles at few samples, what its contacts do, and their impacts.

Sample n stands `step n` seconds after what is shown began. Between the samples that are kept, a link's angle is

    turned(t) = rate t + line(t)

with `line` straight from each to the next, within `tolerance` of every sample that the simulation gave.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, TypeAlias

from geartrain.numerics.arrays import packed
from geartrain.numerics.results import Key, Result
from geartrain.numerics.vectors import Vector
from geartrain.wings import WingResult

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


TimeRun: TypeAlias = Any
"""A `geartrain.simulation.TimeRun`; scenes do not import that wing, not even for types."""


@dataclass(frozen=True, slots=True)
class LinkCourse(Result):
    """The angle of a link through time.

    Attributes
    ----------
    rate : float
        Its mean speed about its declared axis [rad/s].
    samples : array of int, (n,)
        Numbers of the samples that are kept.
    angles : array of float, (n,)
        By how much it has turned since the start, less `rate` times the time [rad].

    See Also
    --------
    SceneRun : holds one for each body.
    """

    KEYS: ClassVar[tuple[str | Key, ...]] = ("rate", Key("samples", "packed_samples"), Key("angles", "packed_angles"))

    rate: float
    samples: Ints
    angles: Floats

    @property
    def packed_samples(self) -> str:
        """The samples as a page carries them: base64 of little-endian uint32."""
        return packed(self.samples, "<u4")

    @property
    def packed_angles(self) -> str:
        """The angles as a page carries them: base64 of little-endian float32."""
        return packed(self.angles, "<f4")


@dataclass(frozen=True, slots=True)
class SceneContact(Result):
    """What teeth, a pin or an escapement do through time.

    Attributes
    ----------
    name : str
        The pair or coupling; of an escapement its link.
    kind : {"pair", "pin", "escapement"}
        What it is.
    body : int
        Index of the body with which the place of its contact moves.
    at : tuple of float
        That place in the zero pose [mm].
    apart, coast : float
        Shares of time in which no flank touches, and on the coast flank.
    blows : float
        Impacts a second [1/s].
    hardest : float
        Greatest closing speed of one, of the driven side [rad/s].
    changes : array of int, (n,)
        Samples from which `states` hold.
    states : str
        One letter each: `d` on the drive flank, `c` on the coast flank, `a` apart; empty where that is not known.
    blow_times, blow_speeds : array of float, (m,)
        Impacts: time since what is shown began [s], closing speed of the driven side [rad/s].

    See Also
    --------
    SceneRun : holds these.
    """

    KEYS: ClassVar[tuple[str | Key, ...]] = (
        "name",
        "kind",
        "body",
        "at",
        "apart",
        "coast",
        "blows",
        "hardest",
        Key("changes", "packed_changes"),
        "states",
        Key("blow_times", "packed_times"),
        Key("blow_speeds", "packed_speeds"),
    )

    name: str
    kind: str
    body: int
    at: Vector
    apart: float
    coast: float
    blows: float
    hardest: float
    changes: Ints
    states: str
    blow_times: Floats
    blow_speeds: Floats

    @property
    def packed_changes(self) -> str:
        """The samples as a page carries them: base64 of little-endian uint32."""
        return packed(self.changes, "<u4")

    @property
    def packed_times(self) -> str:
        """The times as a page carries them: base64 of little-endian float64."""
        return packed(self.blow_times)

    @property
    def packed_speeds(self) -> str:
        """The speeds as a page carries them: base64 of little-endian float32."""
        return packed(self.blow_speeds, "<f4")


@dataclass(frozen=True, slots=True)
class SceneRun(Result):
    """A train in time, ready to be played; angles in rad, times in s.

    Attributes
    ----------
    driven : {"rate", "torque", "spring", "hand"}
        What drives it.
    link : str
        Where power enters.
    rate : float
        Mean speed of the lead [rad/s].
    period : float
        In which the lead would turn once at that speed [s].
    skip, duration : float
        Time before what is shown, and of what is shown [s].
    step : float
        From one sample of the simulation to the next [s].
    tolerance : float
        Within which angles are those of the simulation [rad].
    torque : float
        Mean torque where power enters [N m].
    complete : bool
        False if the simulation was stopped before its end.
    links : sequence of LinkCourse
        Angles, in the order of bodies.
    contacts : sequence of SceneContact
        Teeth, pins and the escapement.
    leads : sequence of geartrain.simulation.OutputLead
        How far outputs are ahead of `motion` and behind.
    notes : sequence of str
        What is left out, and what is drawn as one.

    See Also
    --------
    make_scene : gives it, in `Scene.run`.
    """

    driven: str
    link: str
    rate: float
    period: float
    skip: float
    duration: float
    step: float
    tolerance: float
    torque: float
    complete: bool
    links: Sequence[LinkCourse]
    contacts: Sequence[SceneContact]
    leads: Sequence[Annotated[Any, WingResult("simulation", "OutputLead")]]
    notes: Sequence[str]
