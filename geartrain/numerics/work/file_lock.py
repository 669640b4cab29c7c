"""One writer a journal: a lock that ends with the process that holds it, whatever ends that."""

from __future__ import annotations

import sys

if sys.platform == "win32":

    def lock(descriptor: int) -> bool:
        """True: Windows locks bytes, not files, and would lock readers out too. Two runs are not told apart there."""
        return True

else:
    from fcntl import LOCK_EX, LOCK_NB, flock

    def lock(descriptor: int) -> bool:
        """Take the file for this process; False if another one has it.

        A file system without locks is taken as it is: the lock guards against a slip, it is not needed otherwise.
        """
        try:
            flock(descriptor, LOCK_EX | LOCK_NB)
        except BlockingIOError:
            return False
        except OSError:
            return True
        return True
