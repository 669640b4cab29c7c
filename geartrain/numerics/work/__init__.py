"""Independent work on one machine or many: which executor runs it, and what is kept when it is cut.

`run(work, tasks, executor, journal)` yields the results in the order of the tasks, whichever process does them;
`open_executor()` makes the processes or finds the cluster; a `Journal` keeps what is finished, so that a run killed at
any moment is taken up again and ends the same. Journals are not written through `files`: they are no result for a
reader, and go when the run is whole.
"""

from geartrain.numerics.work.execution import Execution
from geartrain.numerics.work.executors import cores, open_executor
from geartrain.numerics.work.journal import Journal, another_question
from geartrain.numerics.work.task_runner import run

__all__ = ["Execution", "Journal", "another_question", "cores", "open_executor", "run"]
