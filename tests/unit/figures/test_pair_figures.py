"""Figures of complex pairs against the closed form from which their ensemble was made."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

import synthetic
from grainmodes.ensemble import open_ensemble
from grainmodes.ensemble.exceptional import PairSample, pair_samples
from grainmodes.figures.paper_c import pair_birth, pair_exponent, pair_overlap
from grainmodes.figures.shared.pair_samples import choose_sample, longest_pair
from grainmodes.figures.shared.selection import Options


@pytest.fixture(scope="module")
def paired(tmp_path_factory):
    """Two samples each of 8 and 16 grains, and of an area fraction at which none is jammed."""
    stages = ("packings", "complex_pairs")
    folder = tmp_path_factory.mktemp("paired")
    path = synthetic.ensemble(folder, (8, 16), (0.83, 0.9), (1.0,), seeds=2, stages=stages)
    with open_ensemble(path) as dataset:
        yield dataset


def test_samples_know_their_points_and_the_states_around_them(paired):
    found = pair_samples(paired)
    assert [(s.coordinates["n"], s.coordinates["seed"]) for s in found] == [
        (8, 0),
        (8, 1),
        (16, 0),
        (16, 1),
    ]
    one = found[0]
    assert one.exceptional_points["strain"].tolist() == [4e-3, 8e-3]
    assert len(one.neighbours) == 16
    assert len(one.products) == 4 * 13
    assert found[2].products.empty


def test_a_birth_is_shown_from_two_real_modes_to_a_pair(paired):
    table = pair_birth.table(paired, Options())
    assert set(table["n"]) == {16}
    real = table["strain"] <= 4e-3
    assert np.all(table.loc[real, "imaginary"] == 0.0)
    inside = (table["strain"] > 4e-3) & (table["strain"] < 7.9e-3)
    assert np.all(table.loc[inside, "imaginary"] > 0.0)
    assert_allclose(table.loc[inside, "real_1"], table.loc[inside, "real_2"])


@pytest.mark.parametrize(("whole", "shown"), [([True, True], 1), ([True, False], 0)])
def test_a_pair_that_dies_where_two_eigenvalues_meet_is_preferred(whole, shown):
    """C, Fig. 3: real, then a pair, then real again, both times through a coalescence."""
    imaginary = [[0.0, 1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 1.0, 1.0, 0.0]]
    paths = [
        pd.DataFrame({"point": float(point), "strain": np.arange(5.0), "imaginary": values})
        for point, values in enumerate(imaginary)
    ]
    points = pd.DataFrame({"whole": whole})
    sample = PairSample({}, points, pd.DataFrame(), pd.concat(paths), pd.DataFrame())
    assert longest_pair(sample)["point"].unique().tolist() == [shown]


def made_up(n: int, seed: int, whole: bool) -> PairSample:
    """A sample with one path; all are real, a pair, and real again."""
    path = pd.DataFrame({"point": 0.0, "strain": np.arange(3.0), "imaginary": [0.0, 1.0, 0.0]})
    place = {"n": n, "phi": 0.9, "kt": 1.0, "seed": seed}
    points = pd.DataFrame({"whole": [whole]})
    return PairSample(place, points, pd.DataFrame(), path, pd.DataFrame())


def test_the_sample_that_is_shown_has_the_paper_s_size_and_a_whole_pair():
    found = [made_up(1000, 0, True), made_up(500, 1, False), made_up(500, 2, True)]
    chosen = choose_sample([*found, made_up(500, 3, True), made_up(10, 0, True)], Options())
    assert (chosen.coordinates["n"], chosen.coordinates["seed"]) == (500, 2)
    assert choose_sample(found, Options(seed=1)).coordinates["seed"] == 1
    assert choose_sample(found, Options(n=1000)).coordinates["n"] == 1000
    assert choose_sample([], Options()) is None


def test_scalar_products_are_those_of_few_grains_and_of_a_pair(paired):
    table = pair_overlap.table(paired, Options(seed=1))
    few, pair = table[table["mode"].notna()], table[table["mode"].isna()]
    assert (set(few["n"]), set(pair["n"]), set(pair["seed"])) == ({8}, {16}, {1})
    assert set(few.loc[few["other"] != 4, "product"]) == {0.1}
    assert pair["product"].max() == 1.0


def test_differences_grow_as_the_root_of_the_distance(paired):
    table = pair_exponent.table(paired, Options())
    assert set(table["n"]) == {8, 16}
    assert_allclose(table["difference"], 0.1 * np.sqrt(table["distance"]))
    assert set(table.loc[table["birth"] == 1, "point"]) == {0}
    assert pair_exponent.table(paired, Options(n=8))["n"].unique().tolist() == [8]


def test_a_value_that_no_sample_has_is_named(paired):
    with pytest.raises(ValueError, match="seed: expected one of 0, 1 in this ensemble, got 5"):
        pair_birth.table(paired, Options(seed=5))
