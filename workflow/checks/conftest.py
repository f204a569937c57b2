"""The ensemble that is checked, and the report of the consistency checks and their results.

A line of the report begins with "passed", "failed" or "skipped" and names its check. Below it is
said why a check failed. A line that begins with "stated" says what is no failure: samples that are
not jammed, and samples that lose their rigidity.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
import xarray

from grainmodes.ensemble import open_ensemble
from grainmodes.ensemble.lost import LostSample, lost_samples, points_of_stages
from grainmodes.runtime.atomic import replaced
from grainmodes.runtime.workflow_run import end_with_workflow

RESULTS = pytest.StashKey[list[str]]()


def pytest_addoption(parser) -> None:
    """`--ensemble FILE` and `--report FILE`."""
    parser.addoption("--ensemble", type=Path, required=True, help="file of `grainmodes ensemble`")
    parser.addoption("--report", type=Path, required=True, help="text file to write")


def pytest_configure(config) -> None:
    """The checks are a job of the workflow, and end with it."""
    end_with_workflow()


def pytest_generate_tests(metafunc) -> None:
    """Give a check of stages every stage of the ensemble, and every other that lost a sample."""
    if "stage" in metafunc.fixturenames:
        with open_ensemble(metafunc.config.getoption("ensemble")) as opened:
            stages = [*points_of_stages(opened)]
            stages += sorted({sample.stage for sample in lost_samples(opened)} - {*stages})
        metafunc.parametrize("stage", stages)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """Add one line per check, without times, so that equal ensembles have equal reports."""
    report = yield
    if report.when == "call" or report.skipped or report.failed:
        check = item.name.removeprefix("test_").replace("_", " ")
        results = item.session.stash.setdefault(RESULTS, [])
        results.append(f"{report.outcome:8}{check}{_why(report, call)}")
    return report


def _why(report, call) -> str:
    """Why a check was skipped or failed."""
    if report.skipped:
        return f": {report.longrepr[2].removeprefix('Skipped: ')}"
    if not report.failed:
        return ""
    lines = str(call.excinfo.value).splitlines() or [call.typename]
    return f": {lines[0]}" + "".join(f"\n        {line}" for line in lines[1:])


def pytest_sessionfinish(session) -> None:
    """Write the report: one line per check with its result, then what is stated."""
    config = session.config
    with open_ensemble(config.getoption("ensemble")) as opened:
        lines = [*session.stash.get(RESULTS, []), *_statements(opened), ""]
    with replaced(config.getoption("report")) as partial:
        partial.write_text("\n".join(lines), encoding="utf-8")


def _statements(ensemble: xarray.Dataset) -> list[str]:
    """What is no failure and is to be known: one line each."""
    lines = []
    if "jammed" in ensemble:
        converged = ensemble["converged"] == 1
        loose = int((converged & (ensemble["jammed"] == 0)).sum())
        lines += [f"stated  not jammed: {loose} of {int(converged.sum())} converged samples"]
    not_rigid = [sample for sample in lost_samples(ensemble) if sample.kind == "not_rigid"]
    lines += [f"stated  not rigid[{sample.stage}]: {sample}" for sample in not_rigid]
    return lines


@pytest.fixture(scope="session")
def ensemble(request) -> Iterator[xarray.Dataset]:
    """The ensemble; arrays are read when they are used."""
    with open_ensemble(request.config.getoption("ensemble")) as dataset:
        yield dataset


@pytest.fixture(scope="session")
def lost(ensemble) -> list[LostSample]:
    """The samples without a whole result."""
    return lost_samples(ensemble)


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
