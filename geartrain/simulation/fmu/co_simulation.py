"""Gear train as a functional mock-up unit (FMU, FMI 2.0) for co-simulation. The FMU contains the declaration and a
slave that runs geartrain.
"""

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
"""Names of the files in the FMU: the declaration, and the `CoSimulationCase` as JSON."""
_SCRIPT = f'''"""Co-simulation slave of the train in {DECLARATION} next to this file, stepped by geartrain."""

from geartrain.simulation.fmu.co_simulation_slave import TrainSlave, keep_alive

keep_alive(globals())


class Train(TrainSlave):
    pass
'''
_DAY = (1980, 1, 1, 0, 0, 0)  # a fixed date, so that the same train gives the same file
_MODULE = "geartrain_slave"


@dataclass(frozen=True)
class CoSimulationCase(Shown):
    """Settings of a functional mock-up unit (FMU) for co-simulation. None selects the declared value of a setting.

    See Also
    --------
    fmu_file : Takes such an object.
    """

    state: str | None = None
    """Name of a declared state; None for a train that has no states."""
    rate: float | None = None
    """Speed of the first input that turns [rad/s]."""
    step: float | None = None
    """Time step [s]."""
    restitution: float | None = None
    """Coefficient of restitution of every impact, 0 to 1."""
    without: Sequence[str] = ()
    """Names of pairs to omit from the simulation."""


def fmu_file(train: GearTrain, case: CoSimulationCase) -> bytes:
    """Export a train as a Functional Mock-up Unit (FMI 2.0) for co-simulation. The importing tool requires a Python
    installation with geartrain.

    Parameters
    ----------
    train : GearTrain
        Train to export.
    case : CoSimulationCase
        State, input speed and time step of the simulation.

    Returns
    -------
    bytes
        Content of an .fmu file, identical for the same train and case.

    Raises
    ------
    MissingExtraError
        If pythonfmu is not installed.
    QuestionError
        If the train cannot be simulated, for example because no input speed is given, or because a link that can move
        by itself has no inertia.

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
    # a train that cannot be simulated raises its error here, not in the importing tool
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
    """Restore the import path, and remove the script of the FMU from the imported modules, at the end of the context.
    PythonFMU imports this script by name.
    """
    path = list(sys.path)
    try:
        yield
    finally:
        sys.path[:] = path
        sys.modules.pop(_MODULE, None)


def _repacked(data: bytes) -> bytes:
    """Return a copy of a ZIP archive with sorted entries and without modification times."""
    found = BytesIO()
    with ZipFile(BytesIO(data)) as old, ZipFile(found, "w", ZIP_DEFLATED) as new:
        for name in sorted(old.namelist()):
            entry = ZipInfo(name, _DAY)
            entry.compress_type = ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            new.writestr(entry, old.read(name))
    return found.getvalue()
