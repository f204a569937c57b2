"""The ensemble under question, named on the command line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import xarray

from grainmodes.ensemble import open_ensemble


def pytest_addoption(parser) -> None:
    """`--ensemble FILE`: the ensemble to question."""
    parser.addoption("--ensemble", type=Path, required=True, help="file of `grainmodes ensemble`")


@pytest.fixture(scope="session")
def ensemble(request) -> xarray.Dataset:
    """The ensemble; arrays are read when they are used."""
    with open_ensemble(request.config.getoption("ensemble")) as dataset:
        yield dataset


@pytest.fixture(scope="session")
def converged(ensemble) -> xarray.DataArray:
    """Which samples (n, phi, kt, seed) reached the accuracy asked for."""
    return ensemble["converged"] == 1


@pytest.fixture(scope="session")
def protocol(ensemble) -> dict:
    """The numerical choices of the study."""
    return json.loads(ensemble.attrs["config"])["protocol"]
