"""Failures of the machine, as opposed to those of a sample.

| what fails                                                | its type                        |
| --------------------------------------------------------- | ------------------------------- |
| a sample: no equilibrium, no convergence, not rigid       | `linalg.failures`               |
| the machine: memory, a library, the disk, a killed process | `MACHINE_ERRORS`               |

A failure of a sample is a row of its block. A failure of the machine ends the job with a sentence:
nothing is written, and the job runs again. docs/failures.md describes both.
"""

from __future__ import annotations


class MachineError(Exception):
    """What a job needs of its machine is not there; the message is a sentence."""


MACHINE_ERRORS = (MachineError, MemoryError, ImportError, OSError)
"""Errors of the machine; a killed process of a job is a `MachineError`."""


def sentence(error: Exception) -> str:
    """What a user reads of an error of the machine: one sentence, on one line."""
    words = " ".join(str(error).split())
    if isinstance(error, MemoryError):
        reason = f" ({words})" if words else ""
        return f"expected more free memory, got too little{reason}; nothing was written"
    if isinstance(error, ImportError):
        return f"expected a library that can be loaded, got an error ({words}); nothing was written"
    return words
