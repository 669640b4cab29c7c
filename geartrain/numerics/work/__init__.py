"""Independent tasks on one or several machines: executors, ordered results, and journals of interrupted runs.

Results do not depend on the process that computes them, and a run that was killed at any moment can be resumed.
"""

from geartrain.numerics.work.journal import Journal, another_question
from geartrain.numerics.work.task_runner import Execution, cores, open_executor, run

__all__ = ["Execution", "Journal", "another_question", "cores", "open_executor", "run"]
