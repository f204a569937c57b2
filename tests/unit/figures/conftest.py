"""Synthetic ensembles, large enough for every figure; each is built once and only read."""

import pytest
from matplotlib.layout_engine import ConstrainedLayoutEngine

import synthetic
from grainmodes.ensemble import open_ensemble


@pytest.fixture(scope="session")
def path(tmp_path_factory):
    return synthetic.ensemble(tmp_path_factory.mktemp("ensemble"))


@pytest.fixture(scope="session")
def ensemble(path):
    with open_ensemble(path) as dataset:
        yield dataset


@pytest.fixture(scope="session")
def whole(tmp_path_factory):
    """An ensemble from which every figure can be drawn."""
    folder, kts = tmp_path_factory.mktemp("whole"), (0.0, 1e-8, 1e-4, 1.0, 10.0)
    phis, stages = (0.83, 0.86, 0.90), synthetic.WHOLE
    return synthetic.ensemble(folder, (8, 16), phis, kts, seeds=3, stages=stages)


@pytest.fixture(scope="session")
def whole_ensemble(whole):
    with open_ensemble(whole) as dataset:
        yield dataset


@pytest.fixture(scope="session")
def counted_ensemble(tmp_path_factory):
    """The modes of `whole_ensemble` as bins and band averages."""
    folder, kts = tmp_path_factory.mktemp("bins"), (0.0, 1e-8, 1e-4, 1.0, 10.0)
    stages = ("packings", "spectrum_bins")
    path = synthetic.ensemble(folder, (8, 16), (0.83, 0.86, 0.90), kts, seeds=3, stages=stages)
    with open_ensemble(path) as dataset:
        yield dataset


@pytest.fixture
def without_layout(monkeypatch):
    """Leave the axes where they are: making room for the labels takes half the time of a figure."""
    monkeypatch.setattr(ConstrainedLayoutEngine, "execute", lambda self, figure: None)
