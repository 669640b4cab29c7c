"""Files for makers and for other tools: outlines to cut, plates, solids, graphs, tables.

In: a `SolidModel` of `geartrain.scene`, which holds the train, the state and the sizes it is made in; or the outline of
one wheel. Out: bytes and texts of files. Lengths are in mm, in GLB in m. Nothing is computed here but formats: outlines
are those of docs/shapes.md, motions in GLB the exact speeds.

export_files   all files of some kinds, as a folder
train_file     one file with the whole train: STL, GLB, STEP, GraphML, DOT, REXS
wheel_file     one wheel as SVG, DXF or STL
fmu_file       a train that moves in time, as a co-simulation unit
outline_text   the outline of any wheel as SVG, DXF or CSV

Modules: `file_set` lists the files of an export. Formats: `flat_files` (SVG, DXF), `triangle_files` (STL, GLB),
`step_file`, `rexs`, `csv_tables`, `co_simulation` (FMU, with `co_simulation_slave`, which runs in it). What to cut and
how to assemble it: `cut_sheets`, `parts_list`, `assembly_steps`, `assembly_pictures`, `assembly_guide` (the README).
`proof` turns what is written.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.export.co_simulation import CoSimulationCase as CoSimulationCase
    from geartrain.export.co_simulation import fmu_file as fmu_file
    from geartrain.export.file_set import ExportFile as ExportFile
    from geartrain.export.file_set import export_files as export_files
    from geartrain.export.file_set import notices as notices
    from geartrain.export.file_set import train_file as train_file
    from geartrain.export.file_set import wheel_file as wheel_file
    from geartrain.export.flat_files import outline_text as outline_text

__all__ = [
    "CoSimulationCase",
    "ExportFile",
    "export_files",
    "fmu_file",
    "notices",
    "outline_text",
    "train_file",
    "wheel_file",
]

_PLACES = {
    "CoSimulationCase": "co_simulation",
    "ExportFile": "file_set",
    "export_files": "file_set",
    "fmu_file": "co_simulation",
    "notices": "file_set",
    "outline_text": "flat_files",
    "train_file": "file_set",
    "wheel_file": "file_set",
}

__getattr__ = lazy_names(__name__, _PLACES)
