"""Run Snakemake where an earlier run may have been killed.

A killed Snakemake leaves its lock and half-known files behind. This process claims the folder and
becomes Snakemake. Where it has the claim no other run lives, and a lock is stale; then the run goes
on from the files that are whole.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
from pathlib import Path

from grainmodes.configuration import ConfigurationError, read_config
from grainmodes.runtime.failures import MACHINE_ERRORS, sentence
from grainmodes.runtime.workflow_run import claim_folder

LOCKS = Path(".snakemake/locks")


def main(options: list[str]) -> None:
    """Become `snakemake --rerun-incomplete` with these options; does not return.

    Raises:
        SystemExit: another run works in this folder, or a file of the scene cannot be read.
    """
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("--configfile", "--configfiles", nargs="+", default=[])
    try:
        for file in parser.parse_known_args(options)[0].configfile:
            read_config(file)  # Snakemake says of a broken file neither its name nor the line
    except ConfigurationError as error:
        raise SystemExit(f"make study: {error}") from error
    try:
        claim_folder()
        shutil.rmtree(LOCKS, ignore_errors=True)
    except MACHINE_ERRORS as error:
        raise SystemExit(f"make study: {sentence(error)}") from error
    snakemake = str(Path(sys.executable).with_name("snakemake"))
    os.execv(snakemake, [snakemake, "--rerun-incomplete", *options])


if __name__ == "__main__":
    main(sys.argv[1:])
