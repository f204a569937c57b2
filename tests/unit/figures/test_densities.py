"""Densities of states and fractions of the modes, in A's bins, against the ensemble."""

from numpy.testing import assert_allclose, assert_array_equal

import synthetic
from grainmodes.ensemble import open_ensemble, write_ensemble
from grainmodes.ensemble.spectra import spectrum
from grainmodes.figures import draw
from grainmodes.figures.paper_a import (
    dos,
    dos_frictionless,
    dos_n,
    dos_phi,
    dos_scaled,
    participation,
)
from grainmodes.figures.shared.selection import Options


def test_density_of_states_integrates_to_all_vibrations(ensemble):
    table = dos.table(ensemble, Options())
    for _, rows in table.groupby("kt"):
        width = rows["omega_high"] - rows["omega_low"]
        assert_allclose((rows["density"] * width).sum(), (3 * 16 - 2) / (3 * 16))
        assert rows["modes"].sum() == 4 * (3 * 16 - 2)
        assert_array_equal(rows["modes_outside"], 2.0)


def test_every_density_counts_every_mode_once(whole_ensemble, counted_ensemble):
    both = (whole_ensemble, counted_ensemble)
    modules = (dos, dos_n, dos_phi, dos_frictionless)
    for table in [module.table(rows, Options()) for module in modules for rows in both]:
        for (n, _, kt), rows in table.groupby(["n", "phi", "kt"]):
            width = rows["omega_high"] - rows["omega_low"]
            vibrations = (3 if kt else 2) * n - 2
            assert_allclose((rows["density"] * width).sum(), vibrations / (3 * n))
            assert_array_equal(rows["modes_outside"], 2.0)


def test_scaled_density_keeps_the_number_of_modes(ensemble):
    table = dos_scaled.table(ensemble, Options(kt=(1e-4,)))
    assert table["scaled_omega"].between(0.1, 10.0).all()
    width = table["omega_high"] - table["omega_low"]
    integral = (table["density"] * width).sum()
    assert integral >= 1 / 3
    assert_allclose((table["scaled_density"] * width / 1e-2).sum(), integral)
    assert_allclose(table["scaled_omega"], table["omega"] / 1e-2)


def test_fractions_of_the_modes_separate_the_bands(ensemble):
    table = participation.table(ensemble, Options(kt=(1e-4,)))
    filled = table[table["modes"] > 0]
    rotational = filled["omega"] < 0.0125
    assert_array_equal(filled["psi_rotational"][rotational], 1.0)
    assert_array_equal(filled["psi_rotational"][~rotational], 0.0)
    assert_array_equal(filled["psi_translational"], 1.0 - filled["psi_rotational"])
    assert table["psi_rotational"][table["modes"] == 0].isna().all()


def test_bin_density_scales_the_linear_bins(ensemble):
    fine = dos.table(ensemble, Options(kt=(1e-4,), bin_density=1.0))
    coarse = dos.table(ensemble, Options(kt=(1e-4,), bin_density=0.1))
    assert len(fine) - len(coarse) > 500
    assert fine["modes"].sum() == coarse["modes"].sum()


def test_bin_density_is_that_of_the_study_where_no_other_is_asked_for(tmp_path):
    point = synthetic.point(tmp_path, 16, 0.9, 1e-4, 2)
    chosen, bins = {"protocol": {"spectrum": {"bin_density": 0.1}}}, {}
    for name, config in {"silent": {}, "0.1": chosen}.items():
        write_ensemble([point], tmp_path / f"{name}.nc", config)
        with open_ensemble(tmp_path / f"{name}.nc") as dataset:
            bins[name] = dos.table(dataset, Options())["omega"].tolist()
            for requested in (0.1, 0.2):
                bins[requested] = dos.table(dataset, Options(bin_density=requested))[
                    "omega"
                ].tolist()
    assert bins["silent"] == bins[0.2] != bins["0.1"] == bins[0.1]


def test_panels_are_those_of_the_paper_or_spread_evenly(tmp_path):
    kts = (1e-8, 1e-6, 1e-4, 1e-2, 1.0, 10.0)
    with open_ensemble(synthetic.ensemble(tmp_path, phis=(0.9,), kts=kts, seeds=1)) as dataset:
        assert list(dos.table(dataset, Options())["kt"].unique()) == [1e-8, 1e-4, 1.0, 10.0]
    with open_ensemble(synthetic.ensemble(tmp_path, phis=(0.9,), kts=kts[1:], seeds=1)) as dataset:
        assert list(dos.table(dataset, Options())["kt"].unique()) == [1e-6, 1e-4, 1.0, 10.0]


def test_one_sample_has_a_spectrum_without_error(tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.9,), seeds=1)
    with open_ensemble(path) as dataset:
        table = dos.table(dataset, Options())
        assert len(spectrum(dataset, 16, 0.9, 1.0).eigenvalue) == 1
    assert table["density_standard_error"].isna().all()
    draw("participation", path, tmp_path / "participation", {})
