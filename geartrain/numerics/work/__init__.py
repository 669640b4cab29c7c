"""Independent tasks on one or several machines: executors, ordered results, and journals of interrupted runs.

`run(work, tasks, executor, journal)` yields the results in the order of the tasks, independent of the process that
computes them. `open_executor()` starts processes or connects to a cluster. A `Journal` stores finished results, so that
a run that was killed at any moment can be resumed with the same result. Journals are not written through `files`,
because they are not results, and are removed when the run is complete.
"""

from geartrain.numerics.work.journal import Journal, another_question
from geartrain.numerics.work.task_runner import Execution, cores, open_executor, run

__all__ = ["Execution", "Journal", "another_question", "cores", "open_executor", "run"]
