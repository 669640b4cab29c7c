"""A train as a co-simulation unit (FMU, FMI 2.0): its declaration, and a slave that has geartrain step it."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from geartrain.errors import MissingExtraError
from geartrain.numerics.results import Shown
from geartrain.train.declaration_files import write_declaration

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain

DECLARATION, CASE = "train.yaml", "case.json"
"""Files of the unit: the declaration, and how it is asked."""
_SCRIPT = f'''"""The train of {DECLARATION} beside this file, stepped by geartrain."""

from geartrain.simulation.fmu.co_simulation_slave import TrainSlave, keep_alive

keep_alive(globals())


class Train(TrainSlave):
    pass
'''
_DAY = (1980, 1, 1, 0, 0, 0)  # the same train is the same file
_MODULE = "geartrain_slave"


@dataclass(frozen=True)
class CoSimulationCase(Shown):
    """What a co-simulation unit is asked for; all but the state may be None, for what is declared.

    See Also
    --------
    fmu_file : takes it.
    """

    state: str | None = None
    """A declared state."""
    rate: float | None = None
    """Speed of the first input that turns [rad/s]."""
    step: float | None = None
    """Length of a step [s]."""
    restitution: float | None = None
    """Of all impacts."""
    without: Sequence[str] = ()
    """Pairs that are left out."""


def fmu_file(train: GearTrain, case: CoSimulationCase) -> bytes:
    """A train as a co-simulation unit (FMI 2.0), for tools that have Python with geartrain at hand.

    Parameters
    ----------
    train : GearTrain
        The train.
    case : CoSimulationCase
        In which state, how fast.

    Returns
    -------
    bytes
        The content of an .fmu file; the same for the same train.

    Raises
    ------
    MissingExtraError
        If pythonfmu is not installed.
    QuestionError
        If the train does not move in time: nothing says how fast, or a link that can move by itself has no inertia.

    Examples
    --------
    >>> import geartrain
    >>> fmu_file(geartrain.load("moon-triangular-inertia"), CoSimulationCase(rate=6.283185307179586))[:2]
    b'PK'
    """
    try:
        from pythonfmu.builder import FmuBuilder
    except ImportError:
        raise MissingExtraError("pythonfmu", "fmu", "a co-simulation unit") from None
    # whatever does not move is said here, and not in another tool
    train.simulation(case.rate, case.state, step=case.step, restitution=case.restitution, without=case.without)
    with TemporaryDirectory() as folder, _path_kept():
        script, parts = Path(folder) / f"{_MODULE}.py", Path(folder) / "parts"
        parts.mkdir()
        script.write_text(_SCRIPT, encoding="utf-8")
        (parts / DECLARATION).write_text(write_declaration(train.declaration), encoding="utf-8")
        (parts / CASE).write_text(json.dumps(asdict(case)), encoding="utf-8")
        made = FmuBuilder.build_FMU(script, Path(folder) / "train.fmu", [parts / DECLARATION, parts / CASE])
        return _repacked(Path(made).read_bytes())


@contextmanager
def _path_kept() -> Iterator[None]:
    """What is imported, and from where, as before: the builder imports the script by its name."""
    path = list(sys.path)
    try:
        yield
    finally:
        sys.path[:] = path
        sys.modules.pop(_MODULE, None)


def _repacked(data: bytes) -> bytes:
    """The same archive in order and without times."""
    found = BytesIO()
    with ZipFile(BytesIO(data)) as old, ZipFile(found, "w", ZIP_DEFLATED) as new:
        for name in sorted(old.namelist()):
            entry = ZipInfo(name, _DAY)
            entry.compress_type = ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            new.writestr(entry, old.read(name))
    return found.getvalue()
