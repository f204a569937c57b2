"""The ensemble that is checked, and the report of the consistency checks and their results."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
import xarray

from grainmodes.ensemble import open_ensemble

RESULTS = pytest.StashKey[list[str]]()


def pytest_addoption(parser) -> None:
    """`--ensemble FILE` and `--report FILE`."""
    parser.addoption("--ensemble", type=Path, required=True, help="file of `grainmodes ensemble`")
    parser.addoption("--report", type=Path, required=True, help="text file to write")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """Add one line per check, without times, so that equal ensembles have equal reports."""
    report = yield
    if report.when == "call" or report.skipped:
        check = item.name.removeprefix("test_").replace("_", " ")
        why = f": {report.longrepr[2].removeprefix('Skipped: ')}" if report.skipped else ""
        results = item.session.stash.setdefault(RESULTS, [])
        results.append(f"{report.outcome:8}{check}{why}")
    return report


def pytest_sessionfinish(session) -> None:
    """Write the report: one line per check with its result."""
    lines = [*session.stash.get(RESULTS, []), ""]
    session.config.getoption("report").write_text("\n".join(lines), encoding="utf-8")


@pytest.fixture(scope="session")
def ensemble(request) -> Iterator[xarray.Dataset]:
    """The ensemble; arrays are read when they are used."""
    with open_ensemble(request.config.getoption("ensemble")) as dataset:
        yield dataset


@pytest.fixture(scope="session")
def converged(ensemble) -> xarray.DataArray:
    """The samples that reached the requested accuracy, bool (n, phi, kt, seed)."""
    return ensemble["converged"] == 1


@pytest.fixture(scope="session")
def requested(ensemble) -> xarray.DataArray:
    """The samples that the grids of the study request, bool (n, phi, kt, seed)."""
    return ensemble["converged"].notnull()


@pytest.fixture(scope="session")
def protocol(ensemble) -> dict:
    """The numerical choices of the study."""
    return json.loads(ensemble.attrs["config"])["protocol"]
