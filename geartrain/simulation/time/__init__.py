"""Time-domain simulation of a train (docs/dynamics.md, 4 to 6).

train_in_time         entry points: comparison of two runs with time steps h and h/2, and modes of vibration
run_figures           results of one run, with confidence intervals by batch means, and spectra under a Hann window
time_run              classes of the results
stepwise_simulation   a simulation that is advanced step by step
time_report           the report and its data in JSON format; `time_run_plot` is the plot, `verb` the command
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.simulation.time.run_figures import FEWEST as FEWEST
    from geartrain.simulation.time.run_figures import batch_half_width as batch_half_width
    from geartrain.simulation.time.train_in_time import model_in_time as model_in_time

__getattr__, __all__ = public_names(
    __name__,
    {
        "run_figures": "FEWEST batch_half_width",
        "train_in_time": "model_in_time",
    },
)
