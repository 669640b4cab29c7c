"""Independent work on one machine or many: which executor runs it, and what is kept when it is cut.

This room knows no gears. `run(work, tasks, executor, journal)` yields the results in the order of the tasks, whoever
does them; `open_executor()` says who; a `Journal` keeps what is finished, so that a run killed at any moment is taken
up again and ends the same. Journals are the one thing that does not go through `files`, the door to disk: they are no
result for a reader, and they live and die with the run.
"""

from geartrain.numerics.work.execution import Execution
from geartrain.numerics.work.executors import cores, open_executor
from geartrain.numerics.work.journal import Journal, another_question
from geartrain.numerics.work.task_runner import run

__all__ = ["Execution", "Journal", "another_question", "cores", "open_executor", "run"]
