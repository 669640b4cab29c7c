"""Slave inside a co-simulation unit: variables of the train, and a `Simulation` that the importing tool advances.

Names of variables follow FMI's structured naming convention: `angles.moon`, `apart.'d2~e'`.
"""

from __future__ import annotations

import atexit
import ctypes
import json
import re
import sys
from collections.abc import Callable
from functools import cache, partial
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from typing import Any
from uuid import NAMESPACE_URL, uuid5
from xml.etree.ElementTree import Element, SubElement

from pythonfmu import Fmi2Causality, Fmi2Initial, Fmi2Slave, Fmi2Variability, Real
from pythonfmu.enums import Fmi2Status

from geartrain.analysis.gear_train import load
from geartrain.errors import GearTrainError
from geartrain.simulation.fmu.co_simulation import CASE, DECLARATION
from geartrain.simulation.time.stepwise_simulation import Simulation

_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
# exponents of kg, m, s, rad
_UNITS = {
    "rad": (0, 0, 0, 1),
    "rad/s": (0, 0, -1, 1),
    "N.m": (1, 2, -2, 0),
    "J": (1, 2, -2, 0),
    "s": (0, 0, 1, 0),
}

_INPUT = {"causality": Fmi2Causality.input, "variability": Fmi2Variability.continuous}
_PARAMETER = {
    "causality": Fmi2Causality.parameter,
    "variability": Fmi2Variability.fixed,
    "initial": Fmi2Initial.exact,
}
_OUTPUT = {
    "causality": Fmi2Causality.output,
    "variability": Fmi2Variability.continuous,
    "initial": Fmi2Initial.calculated,
}


class TrainSlave(Fmi2Slave):  # type: ignore[misc]
    """Model of a train for co-simulation ("slave" in FMI 2). The train is declared in the resource files of the FMU."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        folder = Path(self.resources)
        text = [(folder / name).read_text(encoding="utf-8") for name in (DECLARATION, CASE)]
        case = json.loads(text[1])
        train = load(folder / DECLARATION)
        self._simulation: Simulation = train.simulation(**case, fast=None)
        self._drive, self._step = self._simulation.drive, self._simulation.step
        self._restitution = dict(self._simulation.restitution)
        self._loads = dict.fromkeys(self._simulation.output_links, 0.0) | self._simulation.loads
        self._changed = self._begun = False
        self._start = 0.0
        self._units: dict[str, str] = {}
        self.modelName = re.sub(r"\W|^(?=\d)", "_", train.name, flags=re.ASCII)
        self.description = train.declaration.title or None
        # the identifier depends only on content and version, so that equal units are identical
        self.guid = uuid5(NAMESPACE_URL, sha256("\0".join((version("geartrain"), *text)).encode()).hexdigest())
        self._register()
        part_in_order(folder.parent / "binaries" / "linux64" / f"{self.modelName}.so")

    # -------------------------------------------------------------------------------------------------------- variables

    def _register(self) -> None:
        kind = self._simulation.drive_kind
        name, unit, what = {
            "rate": ("drive.speed", "rad/s", "prescribed speed"),
            "torque": ("drive.torque", "N.m", "torque"),
            "hand": ("drive.speed", "rad/s", "speed of the hand"),
            "spring": ("", "", ""),
        }[kind]
        link = self._simulation.drive_link
        if name:
            self._add(_INPUT, name, unit, f"{what}, at {link}", lambda: self._drive, partial(self._set, "_drive"))
        for each in self._loads:
            self._add(_INPUT, f"loads.{_quoted(each)}", "N.m", f"torque on {each}", *self._item(self._loads, each))
        self._add(_PARAMETER, "step", "s", "time step", lambda: self._step, partial(self._set, "_step"))
        for each in self._restitution:
            what = f"coefficient of restitution of {each}"
            self._add(_PARAMETER, f"restitution.{_quoted(each)}", "", what, *self._item(self._restitution, each))
        if kind in ("torque", "spring", "hand"):
            self._output("drive.link.speed", "rad/s", f"speed of {link}", lambda of: of.speed)
        if kind != "torque":
            self._output("drive.torque", "N.m", f"mean torque at {link} since the last output", lambda of: of.torque)
        self._output("drive.angle", "rad", f"angle of {link} since the start", lambda of: of.angle)
        for each in self._simulation.angles:
            self._output(f"angles.{_quoted(each)}", "rad", f"angle of {each}", _item("angles", each))
            self._output(f"speeds.{_quoted(each)}", "rad/s", f"speed of {each}", _item("speeds", each))
        for each in self._simulation.apart:
            own = _quoted(each)
            share = f"fraction of the time since the last output in which no flank of {each} touches"
            self._output(f"apart.{own}", "", share, _item("apart", each))
            torque = f"mean torque on the driven side of {each} since the last output"
            self._output(f"torques.{own}", "N.m", torque, _item("torques", each))
            meaning = f"energy lost in impacts of {each} since the last output"
            self._output(f"impact_energy.{own}", "J", meaning, _item("impact_energy", each))

    def _add(
        self,
        attributes: dict[str, Any],
        name: str,
        unit: str,
        what: str,
        get: Callable[[], float],
        put: Callable[[float], None] | None = None,
    ) -> None:
        variable = Real(name, description=what, getter=get, setter=put, **attributes)
        self.register_variable(variable, nested=False)
        self._units[name] = unit

    def _output(self, name: str, unit: str, what: str, of: Callable[[Simulation], float]) -> None:
        self._add(_OUTPUT, name, unit, what, lambda: of(self.simulation))

    def _item(self, values: dict[str, float], name: str) -> tuple[Callable[[], float], Callable[[float], None]]:
        """Return a function that reads and a function that sets the value with one name in `values`."""

        def put(value: float) -> None:
            values[name] = value
            self._changed = True

        return lambda: values[name], put

    def _set(self, attribute: str, value: float) -> None:
        setattr(self, attribute, value)
        self._changed = True

    # ---------------------------------------------------------------------------------------------------- simulation

    @property
    def simulation(self) -> Simulation:
        """Simulation of the train. It is rebuilt if a parameter changes before the first step."""
        if self._changed:
            # before the first step new parameters restart the simulation
            if not self._begun:
                bounces = self._restitution
                self._simulation = self._simulation.anew(
                    step=self._step, restitution=bounces, drive=self._drive, loads=self._loads
                )
            else:
                self._simulation.set_drive(self._drive)
                for link, torque in self._loads.items():
                    self._simulation.set_load(link, torque)
            self._changed = False
        return self._simulation

    def setup_experiment(
        self, start_time: float, stop_time: float | None = None, tolerance: float | None = None
    ) -> None:
        """Set the start time [s] of the simulation."""
        self._start = start_time

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance the simulation to the end of a communication step. If an error occurs, log it and return False."""
        try:
            simulation = self.simulation
            self._begun = True
            # rounding of the tool's times must not give a negative duration
            simulation.advance(max(0.0, current_time + step_size - self._start - simulation.time))
        except GearTrainError as error:
            self.log(str(error), Fmi2Status.error)
            return False
        return True

    # -------------------------------------------------------------------------------------------------------- as XML

    def to_xml(self, model_options: dict[str, str] | None = None) -> Element:
        """Return the model description with units and bounds but without the generation date."""
        root: Element = super().to_xml(model_options or {})
        # a date would make identical units differ
        del root.attrib["generationDateAndTime"]
        root.set("generationTool", f"geartrain {version('geartrain')} by {root.get('generationTool')}")
        units = Element("UnitDefinitions")
        for name, exponents in _UNITS.items():
            base = zip(("kg", "m", "s", "rad"), exponents, strict=True)
            SubElement(
                SubElement(units, "Unit", name=name), "BaseUnit", {key: str(value) for key, value in base if value}
            )
        root.insert(1, units)
        for variable in root.iter("ScalarVariable"):
            name, real = variable.get("name", ""), variable[0]
            if self._units[name]:
                real.set("unit", self._units[name])
            if name.startswith("restitution."):
                real.attrib |= {"min": "0", "max": "1"}
            if "start" in real.attrib:
                real.set("start", repr(float(self.vars[int(variable.get("valueReference", "0"))].start)))
        unknown = root.find("ModelStructure/Outputs")
        if unknown is not None:
            first = SubElement(root.find("ModelStructure"), "InitialUnknowns")  # type: ignore[arg-type]
            first.extend(Element("Unknown", index=each.get("index", "")) for each in unknown)
        return root


def keep_alive(names: dict[str, Any]) -> None:
    """Add a reference to the global variables of the FMU's script, which is never released, each time the script runs.

    This compensates for a fault of PythonFMU 0.7.0: on each call of Python, the PythonFMU library releases a reference
    that it does not own.
    """
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(names))


@cache
def part_in_order(library: Path) -> None:
    """Register an exit handler that finalises the library before the process ends, if the process is Python.

    Without this handler, the library frees its memory twice at the end (PythonFMU 0.7.0 on Linux): first with all
    static objects, and again when the library is unloaded.
    """
    if sys.platform == "linux" and sys.orig_argv and library.is_file():
        atexit.register(ctypes.CDLL(str(library)).finalizePythonInterpreter)


def _item(what: str, name: str) -> Callable[[Simulation], float]:
    return lambda of: float(getattr(of, what)[name])


def _quoted(name: str) -> str:
    """Return a name as required between the dots of a variable name in FMI: in quotation marks if it is not plain."""
    if _PLAIN.fullmatch(name):
        return name
    return "'" + name.replace("\\", "\\\\").replace("'", "\\'") + "'"
