"""`python -m grainmodes`: the command `grainmodes`."""

from __future__ import annotations

import sys

from grainmodes.cli import main

if __name__ == "__main__":
    sys.exit(main())
