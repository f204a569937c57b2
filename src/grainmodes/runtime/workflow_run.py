"""The workflow runs once at a time in a folder, and its jobs end with it.

Snakemake's own lock has no owner: who removes a stale one must know that nobody works there. The
claim of the folder says so, and holds for all studies of the folder, because a run of Snakemake
that ends removes the locks of all others.
"""

from __future__ import annotations

import atexit
import json
import os
import sys
import threading
import time
from pathlib import Path

from grainmodes.runtime import claims
from grainmodes.runtime.partial_files import remove_partial_files_in
from grainmodes.runtime.processes import LOOK_EVERY, Process
from grainmodes.runtime.supervisor import WORKFLOW, workflow

CLAIM = Path(".snakemake") / "run.claim"
"""The claim of a folder; Snakemake's own locks lie beside it."""


def claim_folder() -> claims.Claim:
    """The claim of the current folder, for this process and what it becomes by `exec`.

    Raises:
        ClaimedError: a run that works there lives.
        OSError: the folder cannot be written.
    """

    def tell(sentence: str) -> None:
        print(sentence, file=sys.stderr, flush=True)

    return claims.take(CLAIM, f"the workflow in {Path.cwd()}", wait=False, tell=tell)


def start_run(results: Path) -> None:
    """Claim the current folder until this process ends, and remove half-written results.

    Raises:
        ClaimedError, OSError: as `claim_folder`.
    """
    claim = claim_folder()
    atexit.register(claim.release)
    claim.touch()
    remove_partial_files_in(results, CLAIM.stat().st_mtime)
    claim.touch_in_background()


def name_to_jobs() -> None:
    """Name this process to its jobs, which end with it."""
    os.environ[WORKFLOW] = json.dumps(Process.current()._asdict())


def end_with_workflow() -> None:
    """From now on this process, a job without a supervisor, ends with its workflow."""
    owner = workflow()
    if owner:
        threading.Thread(target=_watch, args=(owner,), daemon=True).start()


def _watch(owner: Process) -> None:
    while not owner.is_gone:
        time.sleep(LOOK_EVERY)
    print(f"ended, because the workflow has ended ({owner})", file=sys.stderr, flush=True)
    os._exit(1)
