"""Processes that belong to one command: they inherit a word in their environment."""

from __future__ import annotations

import psutil


def marked_processes(word: str) -> list[psutil.Process]:
    """The processes that live and have MARKED=word in their environment, by number."""
    found = []
    for process in psutil.process_iter():
        try:
            marked = process.environ().get("MARKED") == word
            if marked and process.status() != psutil.STATUS_ZOMBIE:
                found.append(process)
        except psutil.Error:
            continue
    return sorted(found, key=lambda process: process.pid)
