"""The ensemble under question, and the report of the answers."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
import xarray

from grainmodes.ensemble import open_ensemble

ANSWERS = pytest.StashKey[list[str]]()


def pytest_addoption(parser) -> None:
    """`--ensemble FILE` and `--report FILE`."""
    parser.addoption("--ensemble", type=Path, required=True, help="file of `grainmodes ensemble`")
    parser.addoption("--report", type=Path, required=True, help="text file to write")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """Note one line per question; no times, so that the same ensemble has the same report."""
    report = yield
    if report.when == "call" or report.skipped:
        question = item.name.removeprefix("test_").replace("_", " ")
        why = f": {report.longrepr[2].removeprefix('Skipped: ')}" if report.skipped else ""
        answers = item.session.stash.setdefault(ANSWERS, [])
        answers.append(f"{report.outcome:8}{question}{why}")
    return report


def pytest_sessionfinish(session) -> None:
    """Write the report."""
    lines = [*session.stash.get(ANSWERS, []), ""]
    session.config.getoption("report").write_text("\n".join(lines), encoding="utf-8")


@pytest.fixture(scope="session")
def ensemble(request) -> Iterator[xarray.Dataset]:
    """The ensemble; arrays are read when they are used."""
    with open_ensemble(request.config.getoption("ensemble")) as dataset:
        yield dataset


@pytest.fixture(scope="session")
def converged(ensemble) -> xarray.DataArray:
    """Which samples (n, phi, kt, seed) reached the accuracy asked for."""
    return ensemble["converged"] == 1


@pytest.fixture(scope="session")
def asked(ensemble) -> xarray.DataArray:
    """Which samples (n, phi, kt, seed) the grids of the study ask for."""
    return ensemble["converged"].notnull()


@pytest.fixture(scope="session")
def protocol(ensemble) -> dict:
    """The numerical choices of the study."""
    return json.loads(ensemble.attrs["config"])["protocol"]
