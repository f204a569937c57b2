"""The plotted numbers against the ensemble, and the three files of a figure."""

import time

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import synthetic
from grainmodes.dataset import BlockError
from grainmodes.ensemble import open_ensemble, write_ensemble
from grainmodes.ensemble.averages import spectrum
from grainmodes.figures import (
    appearance,
    dos,
    dos_scaled,
    draw,
    g_kt,
    g_nonaffine,
    g_phi,
    participation,
)
from grainmodes.figures.selection import Options
from grainmodes.parameters import FIGURES

OF_ENSEMBLES = [name for name, figure in FIGURES.items() if figure.source == "ensemble"]


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return synthetic.ensemble(tmp_path_factory.mktemp("ensemble"))


@pytest.fixture(scope="module")
def ensemble(path):
    with open_ensemble(path) as dataset:
        yield dataset


@pytest.mark.parametrize("name", OF_ENSEMBLES)
def test_a_figure_is_a_picture_a_vector_picture_and_its_numbers(name, path, tmp_path):
    draw(name, path, tmp_path / name, {})
    assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / f"{name}.pdf").read_bytes().startswith(b"%PDF")
    header = [line for line in (tmp_path / f"{name}.csv").open() if line.startswith("#")]
    numbers = pd.read_csv(tmp_path / f"{name}.csv", comment="#")
    assert header[0] == f"# {FIGURES[name].title}\n"
    assert [line.split()[1] for line in header[1:]] == list(numbers.columns)
    assert len(numbers)
    assert len(list(tmp_path.iterdir())) == 3


def test_the_same_ensemble_gives_the_same_bytes(path, tmp_path):
    for run in ("first", "second"):
        draw("g_phi", path, tmp_path / run, {})
        time.sleep(1.1)
    for suffix in (".png", ".pdf", ".csv"):
        first, second = (tmp_path / f"{run}{suffix}" for run in ("first", "second"))
        assert first.read_bytes() == second.read_bytes()


def test_rigidity_is_the_mean_over_samples_with_its_error(ensemble):
    table = g_phi.table(ensemble, Options())
    (row,) = table[
        (table["phi"] == 0.90) & (table["kt"] == 1.0) & (table["kind"] == "theory")
    ].to_dict("records")
    values = ensemble["g"].sel(n=16, phi=0.90, kt=1.0).to_numpy()
    assert_allclose(row["rigidity"], values.mean())
    assert_allclose(row["standard_error"], values.std(ddof=1) / 2)
    assert (row["samples"], row["fraction_jammed"]) == (4, 1.0)


def test_the_unit_of_a_modulus_follows_the_contact_law(tmp_path):
    point = synthetic.point(tmp_path, 16, 0.9, 1.0, 2)
    for law, label in {"hertz": "$G$ / $(k_N d^{1/2})$", "harmonic": "$G$ / $k_N$"}.items():
        write_ensemble([point], tmp_path / f"{law}.nc", {"contact_law": {"normal": law}})
        with open_ensemble(tmp_path / f"{law}.nc") as dataset:
            assert appearance.modulus_label("$G$", g_phi.table(dataset, Options())) == label


def test_unjammed_points_are_drawn_at_zero(ensemble):
    table = g_phi.table(ensemble, Options())
    below = table[table["phi"] == 0.83]
    assert len(below) == 2 * 4
    assert_array_equal(below["rigidity"], 0.0)
    assert_array_equal(below["fraction_jammed"], 0.0)


def test_unloaded_and_loaded_stand_in_one_table(ensemble):
    table = g_nonaffine.table(ensemble, Options())
    means = table[table["phi"] == 0.90].pivot(index="kt", columns="kind", values="rigidity")
    expected = ensemble["g_nonaffine_loaded"].sel(n=16, phi=0.90).mean("seed")
    assert_allclose(means["loaded"], expected)
    assert means["unloaded"][10.0] > 0 > means["loaded"][10.0]


def test_simulation_is_left_out_where_the_study_has_none(tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.9,), stages=("packings", "rigidity"))
    with open_ensemble(path) as dataset:
        assert set(g_kt.table(dataset, Options())["kind"]) == {"theory"}
    draw("g_kt", path, tmp_path / "g_kt", {})


def test_density_of_states_integrates_to_all_vibrations(ensemble):
    table = dos.table(ensemble, Options())
    for _, of in table.groupby("kt"):
        width = of["omega_high"] - of["omega_low"]
        assert_allclose((of["density"] * width).sum(), (3 * 16 - 2) / (3 * 16))
        assert of["modes"].sum() == 4 * (3 * 16 - 2)
        assert_array_equal(of["zero_modes"], 2.0)


def test_figures_show_the_largest_n_and_spectral_ones_the_largest_phi(tmp_path):
    path = synthetic.ensemble(tmp_path, ns=(8, 16), phis=(0.86, 0.88), kts=(1.0,), seeds=2)
    with open_ensemble(path) as dataset:
        table = dos.table(dataset, Options())
        asked = dos.table(dataset, Options(n=8, phi=0.86))
        rigidity = g_phi.table(dataset, Options())
    assert (set(table["n"]), set(table["phi"])) == ({16}, {0.88})
    assert (set(asked["n"]), set(asked["phi"])) == ({8}, {0.86})
    assert (set(rigidity["n"]), set(rigidity["phi"])) == ({16}, {0.86, 0.88})


def test_spectral_figures_show_the_largest_phi_that_has_spectra(tmp_path):
    points = [
        synthetic.point(tmp_path, 16, 0.86, 1.0, 2),
        synthetic.point(tmp_path, 16, 0.90, 1.0, 2, stages=("packings", "rigidity")),
    ]
    write_ensemble(points, tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        assert set(dos.table(dataset, Options())["phi"]) == {0.86}
        with pytest.raises(ValueError, match=r"phi = 0.9: .* can show 0\.86"):
            dos.table(dataset, Options(phi=0.90))


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


def test_fineness_scales_the_linear_bins(ensemble):
    fine = dos.table(ensemble, Options(kt=(1e-4,)))
    coarse = dos.table(ensemble, Options(kt=(1e-4,), fineness=0.1))
    assert len(fine) - len(coarse) > 500
    assert fine["modes"].sum() == coarse["modes"].sum()


def test_panels_are_those_of_the_paper_or_spread_evenly(tmp_path):
    kts = (1e-8, 1e-6, 1e-4, 1e-2, 1.0, 10.0)
    with open_ensemble(synthetic.ensemble(tmp_path, phis=(0.9,), kts=kts, seeds=1)) as dataset:
        assert list(dos.table(dataset, Options())["kt"].unique()) == [1e-8, 1e-4, 1.0, 10.0]
    with open_ensemble(synthetic.ensemble(tmp_path, phis=(0.9,), kts=kts[1:], seeds=1)) as dataset:
        assert list(dos.table(dataset, Options())["kt"].unique()) == [1e-6, 1e-4, 1.0, 10.0]


@pytest.mark.parametrize("name", OF_ENSEMBLES)
def test_a_study_without_a_jammed_sample_still_has_its_figures(name, tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.83,), seeds=1)
    draw(name, path, tmp_path / name, {})
    assert (tmp_path / f"{name}.pdf").exists()


def test_one_sample_has_a_spectrum_without_error(tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.9,), seeds=1)
    with open_ensemble(path) as dataset:
        table = dos.table(dataset, Options())
        assert len(spectrum(dataset, 16, 0.9, 1.0).eigenvalue) == 1
    assert table["density_standard_error"].isna().all()
    draw("participation", path, tmp_path / "participation", {})


@pytest.mark.parametrize(
    ("name", "options", "sentence"),
    [
        ("g_psi", {}, "figure 'g_psi': expected one of g_phi, g_kt"),
        ("dos", {"colour": "red"}, "figure dos: unknown option 'colour', allowed are n, phi, kt"),
        (
            "dos",
            {"phi": 0.87},
            "phi = 0.87: of this ensemble, the figure can show 0.83, 0.86, 0.9",
        ),
        ("dos", {"kt": (3.0,)}, "kt = 3.0: of this ensemble, the figure can show 1e-08"),
        ("dos", {"n": 17}, "n = 17: of this ensemble, the figure can show 16"),
        ("dos", {"fineness": 0.0}, r"fineness is 0.0, allowed is \(0, 1\]"),
    ],
)
def test_what_cannot_be_drawn_is_refused_and_leaves_no_file(
    name, options, sentence, path, tmp_path
):
    with pytest.raises(ValueError, match=sentence):
        draw(name, path, tmp_path / "figure", options)
    assert not list(tmp_path.iterdir())


def test_observables_that_a_figure_needs_are_named(tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.9,), kts=(0.0,), stages=("packings", "rigidity"))
    for name, sentence in {
        "dos": "holds no eigenvalue",
        "participation": "holds no psi_rotational",
    }.items():
        with pytest.raises(BlockError, match=sentence):
            draw(name, path, tmp_path / "figure", {})
    with pytest.raises(ValueError, match="figure g_kt: the ensemble has no k_T > 0"):
        draw("g_kt", path, tmp_path / "figure", {})


def test_a_figure_that_fails_half_way_leaves_the_old_one(path, tmp_path, monkeypatch):
    draw("g_phi", path, tmp_path / "figure", {})
    before = {entry.name: entry.read_bytes() for entry in tmp_path.iterdir()}

    def no_space(*_, **__):
        raise OSError("no space left on device")

    monkeypatch.setattr(pd.DataFrame, "to_csv", no_space)
    with pytest.raises(OSError, match="no space"):
        draw("g_phi", path, tmp_path / "figure", {"kt": (1.0,)})
    assert {entry.name: entry.read_bytes() for entry in tmp_path.iterdir()} == before


@pytest.mark.parametrize(
    ("value", "text"),
    [(1e-8, "10^{-8}"), (0.0, "0"), (2.0, "2"), (0.03, r"3\times 10^{-2}"), (1e-2, "10^{-2}")],
)
def test_numbers_as_formulas(value, text):
    assert appearance.power(value) == text


def test_labels_of_samples_and_fractions():
    assert appearance.samples([8, 8]) == "8 samples"
    assert appearance.samples(np.array([6, 8])) == "6–8 samples"
    assert appearance.samples([1]) == "1 sample"
    assert [appearance.fraction(phi) for phi in (0.9, 0.845)] == ["0.90", "0.845"]
