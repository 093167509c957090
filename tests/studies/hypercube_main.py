"""A hypercube in processes that are there to be killed: the script of test_hypercube.py.

It reads lines "METHOD MACHINES FOLDER". For each it starts a process with a session of its own that runs the
hypercube into that folder, and prints the process's id and, when it has ended, its exit code. METHOD is how
that process starts its workers: "spawn", as every run does, or "fork", which spares them the seconds of
importing everything again. The process itself is forked for the same reason; it ends by SIGKILL as any other.
"""

from __future__ import annotations

import multiprocessing
import os
import sys
from pathlib import Path

SEED = 1
WORKERS = 2
PROGRAM = "this program"  # in place of the digest of its sources, which may be edited while the tests run


def main() -> None:
    """Until there are no more lines."""
    from studies.claims import hypercube, plausible
    from support_exudyn.sweeps import workers
    from support_exudyn.sweeps.warm_up import warm_up

    hypercube._program = lambda: PROGRAM  # type: ignore[assignment]
    warm_up()
    for line in sys.stdin:
        method, count, folder = line.rstrip("\n").split(" ", 2)
        machines = plausible.samples(int(count), SEED)
        process = os.fork()
        if not process:
            os.setsid()
            workers.CONTEXT = multiprocessing.get_context(method)  # type: ignore[assignment]
            hypercube.run(machines, Path(folder), WORKERS, lambda done, of: None)
            os._exit(0)
        print(process, flush=True)
        print(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), flush=True)


if __name__ == "__main__":
    main()
