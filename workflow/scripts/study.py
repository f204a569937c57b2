"""Run Snakemake where an earlier run may have been killed.

A killed Snakemake leaves its lock and half-known files behind. Where no Snakemake is alive in this
folder the lock is stale and is removed; then the run goes on from the files that are whole.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import psutil


def main(options: list[str]) -> None:
    """Become `snakemake --rerun-incomplete` with these options; does not return."""
    snakemake = str(Path(sys.executable).with_name("snakemake"))
    if any(Path(".snakemake/locks").glob("*")) and not running_in(Path.cwd()):
        subprocess.run([snakemake, "--unlock", *options], check=True)
    os.execv(snakemake, [snakemake, "--rerun-incomplete", *options])


def running_in(folder: Path) -> list[int]:
    """Process ids of the Snakemakes that work in a folder."""
    processes = psutil.process_iter(["pid", "cwd", "cmdline"])
    return [
        process.info["pid"]
        for process in processes
        if process.info["cwd"] == str(folder)
        and any(Path(word).name == "snakemake" for word in process.info["cmdline"] or [])
    ]


if __name__ == "__main__":
    main(sys.argv[1:])
