"""Independent work on one machine or many: which executor runs it, and what is kept when it is interrupted.

`run(work, tasks, executor, journal)` yields the results in the order of the tasks, whichever process does them;
`open_executor()` starts processes or connects to a cluster; a `Journal` keeps what is finished, so that a run killed
at any moment is resumed and ends the same. Journals are not written through `files`: they are not results for a
reader, and are removed when the run is complete.
"""

from geartrain.numerics.work.executors import cores, open_executor
from geartrain.numerics.work.journal import Journal, another_question
from geartrain.numerics.work.task_runner import Execution, run

__all__ = ["Execution", "Journal", "another_question", "cores", "open_executor", "run"]
