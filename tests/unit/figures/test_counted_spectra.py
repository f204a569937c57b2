"""Spectra that a study counted in bins: the figures are those of the modes."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import synthetic
from grainmodes.dataset.files import BlockError, write_block
from grainmodes.ensemble import merge_blocks, open_ensemble, write_ensemble
from grainmodes.ensemble.spectra import binned_spectrum, spectrum
from grainmodes.figures.paper_a import dos, dos_phi, participation, participation_ratio
from grainmodes.figures.shared import spectral_rows
from grainmodes.figures.shared.selection import Options

POINT = (16, 0.90, 1e-4)


def test_modes_and_bins_give_the_same_numbers(whole_ensemble, counted_ensemble):
    for kt in (0.0, 1e-8, 1e-4, 10.0):
        point = (16, 0.90, kt)
        bins = binned_spectrum(counted_ensemble, *point)
        modes = spectrum(whole_ensemble, *point).in_bins(bins.edges)
        assert_array_equal(bins.edges, synthetic.edges(kt))
        assert_array_equal(bins.count, modes.count)
        assert_array_equal(bins.outside, modes.outside)
        assert_allclose(bins.psi_rotational.total, modes.psi_rotational.total, atol=1e-12)
        p = modes.participation_ratio.total
        assert_allclose(bins.participation_ratio.total, p, atol=1e-12)
        assert_allclose(bins.participation_ratio.error, 0.02 * modes.count)


def test_figures_of_bins_are_those_of_the_modes_on_their_edges(whole_ensemble, counted_ensemble):
    found = participation_ratio.table(counted_ensemble, Options(kt=(1e-4,)))
    modes = spectrum(whole_ensemble, *POINT).in_bins(synthetic.edges(1e-4))
    expected = spectral_rows.rows_of_bins(modes, POINT, "without")
    expected = expected[list(participation_ratio.COLUMNS)]
    error = "participation_ratio_standard_error"
    pd.testing.assert_frame_equal(found.drop(columns=error), expected.drop(columns=error))
    total = np.where(found["modes"] > 0, found["modes"], np.nan)
    stated = 0.02 * np.sqrt((modes.count**2).sum(axis=0)) / total
    assert_allclose(found[error], np.fmax(expected[error], stated))
    assert (found[error] > expected[error]).any()


def test_unjammed_samples_have_no_rows_and_no_curve(whole_ensemble, counted_ensemble):
    for dataset in (whole_ensemble, counted_ensemble):
        assert list(dos_phi.table(dataset, Options())["phi"].unique()) == [0.86, 0.90]


def test_an_unjammed_sample_counts_as_zero_beside_jammed_ones(tmp_path):
    blocks = [
        synthetic.block(stage, 16, 0.9, 1e-4, range(2)) for stage in ("packings", "spectrum_bins")
    ]
    blocks[0].variables["jammed"][1] = 0
    blocks[1].variables["bin_edge"][1] = np.nan
    blocks[1].variables["bin_count"][1] = 0
    write_block(tmp_path / "point.nc", merge_blocks(dict(zip("ab", blocks, strict=True))))
    write_ensemble([tmp_path / "point.nc"], tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        table = dos.table(dataset, Options())
    assert set(table["samples"]) == {2}
    width = table["omega_high"] - table["omega_low"]
    assert_allclose((table["density"] * width).sum(), 46 / 48 / 2)
    assert_array_equal(table["modes_outside"], 1.0)


def test_samples_counted_in_different_bins_are_refused(tmp_path):
    block = synthetic.block("spectrum_bins", 16, 0.9, 1e-4, range(2))
    block.variables["bin_edge"][1] *= 1.01
    packings = synthetic.block("packings", 16, 0.9, 1e-4, range(2))
    write_block(tmp_path / "point.nc", merge_blocks({"a": packings, "b": block}))
    write_ensemble([tmp_path / "point.nc"], tmp_path / "ensemble.nc", {})
    with (
        open_ensemble(tmp_path / "ensemble.nc") as dataset,
        pytest.raises(BlockError, match=r"n = 16, phi = 0.9, kt = 0.0001: .* different bins"),
    ):
        dos.table(dataset, Options())


def test_one_sample_of_averages_has_the_error_stated_for_it(tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.9,), seeds=1, stages=("packings", "spectrum_bins"))
    with open_ensemble(path) as dataset:
        table = participation.table(dataset, Options(kt=(1e-4,)))
    filled = table[table["modes"] > 0]
    assert_allclose(filled["psi_standard_error"], 0.01)
