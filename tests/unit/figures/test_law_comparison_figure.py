"""Pairs under several laws as they are drawn, against the numbers they were made from."""

import numpy as np
import pytest

import synthetic
from grainmodes.ensemble import open_ensemble
from grainmodes.figures.paper_c import law_comparison
from grainmodes.figures.shared.selection import Options
from grainmodes.parameters.law import TANGENTIAL_LAWS


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    """Three samples of two points, one of them not jammed."""
    stages = ("packings", "law_comparison")
    folder = tmp_path_factory.mktemp("law_comparison")
    path = synthetic.ensemble(folder, phis=(0.83, 0.9), kts=(1.0,), seeds=3, stages=stages)
    with open_ensemble(path) as dataset:
        yield law_comparison.table(dataset, Options())


def test_pairs_are_means_over_the_samples(table):
    rows = table[table["kind"] == "pairs"]
    assert list(table.columns) == list(law_comparison.COLUMNS)
    assert set(rows["tangential"]) == set(TANGENTIAL_LAWS) == set(law_comparison.LAW_NAMES)
    assert set(rows["phi"]) == {0.9} and set(rows["samples"]) == {3}
    sharp = rows[rows["tangential"] == "sharp_coulomb"]
    np.testing.assert_allclose(sharp["strain"], np.arange(1, 6) * 1e-3)
    np.testing.assert_allclose(sharp["pairs"], [0, 1, 0, 1, 0])
    np.testing.assert_allclose(sharp["pairs_sticking"], 0.0)


def test_every_released_state_is_a_row(table):
    rows = table[table["kind"] == "release"]
    assert rows.groupby("tangential").size().to_dict() == dict.fromkeys(
        [law for law in TANGENTIAL_LAWS if law != "elastic_force"], 6
    )
    smooth = rows[rows["tangential"] == "smoothed_coulomb"]
    np.testing.assert_allclose(smooth["growth"] / smooth["rate"], 1.0)
    np.testing.assert_allclose(rows.loc[rows["tangential"] == "sharp_coulomb", "growth"], 0.0)
