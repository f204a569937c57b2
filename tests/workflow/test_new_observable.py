"""A new observable takes three places: its function, its entry in the table, its variables.

From these follow its command, key, rule, files, gathered numbers and cost.
"""

import os
import subprocess
import sys

import netCDF4
import numpy as np

from grainmodes.dataset.files import read_block

from .conftest import SCENE

FUNCTION = '''
"""The stage `compactness`: contacts per grain of every packing, rattlers included."""

from __future__ import annotations

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import StepStrain
from grainmodes.stages.rows import response_block


def compactness_block(packings: Block, law: ContactLaw, step: StepStrain) -> Block:
    """2 / N times the number of contacts, and the step of a strain."""

    def sample(number: int) -> dict[str, object]:
        contacts = np.count_nonzero(packings.variables["contact_i"][number] >= 0)
        grains = len(packings.variables["diameter"][number])
        return {"compactness": 2.0 * contacts / grains, "converged": step.strain > 0.0}

    return response_block(packings, "compactness", {}, law, sample)
'''

ENTRY = """
    Stage(
        "compactness",
        "Contacts per grain, rattlers included.",
        "grainmodes.stages.compactness:compactness_block",
        "compactness",
        arguments={"step": "protocol.step_strain"},
    ),
)

STAGES"""

VARIABLES = """
NAMES["compactness"] = Variable(BLOCK, "f8", NUMBER, "contacts per grain, rattlers included")
"""


def add_observable(package) -> None:
    """Add it as a contributor would."""
    (package / "stages" / "compactness.py").write_text(FUNCTION)
    table = package / "parameters" / "stages.py"
    table.write_text(table.read_text().replace("\n)\n\nSTAGES", ENTRY, 1))
    names = package / "dataset" / "rigidity.py"
    made = names.stat().st_mtime
    names.write_text(names.read_text() + VARIABLES)
    # The table of variables is code of every stage; its old time spares the test most of the study.
    os.utime(names, (made, made))


def test_a_new_observable_takes_three_places(study, monkeypatch):
    package = study.folder / "src" / "grainmodes"
    before = {path: path.read_bytes() for path in package.rglob("*.py")}
    add_observable(package)
    after = {path: path.read_bytes() for path in package.rglob("*.py")}
    assert sum(before.get(path) != text for path, text in after.items()) == 3
    monkeypatch.setenv("PYTHONPATH", str(study.folder / "src"))

    grid = SCENE["grids"][0] | {"observables": {"compactness": True}}
    study.write_scene(SCENE | {"grids": [grid]})
    assert study.planned("results/tiny/ensemble.nc") == {
        "compactness": 4,
        "point": 4,
        "ensemble": 1,
    }
    study.run("results/tiny/ensemble.nc")
    with netCDF4.Dataset(study.results / "ensemble.nc") as ensemble:
        gathered = ensemble["compactness"][0, 1, 1]  # n = 16, phi = 0.85, k_T = 1
    packings = read_block(study.results / "packings" / "n~16" / "phi~0.85" / "seeds~0000-0001.nc")
    contacts = np.count_nonzero(packings.variables["contact_i"] >= 0, axis=1)
    np.testing.assert_array_equal(gathered, contacts / 8)

    (row,) = (line for line in output(study, "cost", "config/tiny.yaml") if "compactness" in line)
    assert row.endswith("?"), "its cost was never measured"
    assert "Contacts per grain, rattlers included." in output(study, "compactness", "--help")


def output(study, *words: str) -> list[str]:
    """What a command of the copied package prints."""
    script = "import sys; from grainmodes.cli import main; sys.exit(main())"
    command = [sys.executable, "-c", script, *words]
    run = subprocess.run(command, cwd=study.folder, capture_output=True, text=True, check=True)
    return run.stdout.splitlines()
