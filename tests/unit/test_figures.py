"""The plotted numbers against the ensemble, and the three files of a figure."""

import time

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import synthetic
from grainmodes.dataset.files import BlockError, read_block, write_block
from grainmodes.ensemble import merge_blocks, open_ensemble, write_ensemble
from grainmodes.ensemble.spectra import counted, points_with, spectrum
from grainmodes.figures import (
    appearance,
    dos,
    dos_frictionless,
    dos_hessian,
    dos_n,
    dos_phi,
    dos_rattlers,
    dos_scaled,
    draw,
    g_kt,
    g_nonaffine,
    g_phi,
    participation,
    participation_ratio,
    spectral_rows,
)
from grainmodes.figures.selection import Options
from grainmodes.parameters.figures import FIGURES

OF_ENSEMBLES = [name for name, figure in FIGURES.items() if figure.source == "ensemble"]


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return synthetic.ensemble(tmp_path_factory.mktemp("ensemble"))


@pytest.fixture(scope="module")
def ensemble(path):
    with open_ensemble(path) as dataset:
        yield dataset


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """An ensemble from which every figure can be drawn."""
    folder, kts = tmp_path_factory.mktemp("whole"), (0.0, 1e-8, 1e-4, 1.0, 10.0)
    phis, stages = (0.83, 0.86, 0.90), synthetic.WHOLE
    return synthetic.ensemble(folder, (8, 16), phis, kts, seeds=3, stages=stages)


@pytest.fixture(scope="module")
def whole_ensemble(whole):
    with open_ensemble(whole) as dataset:
        yield dataset


@pytest.fixture(scope="module")
def counted_ensemble(tmp_path_factory):
    """The modes of `whole_ensemble` as bins and band averages."""
    folder, kts = tmp_path_factory.mktemp("bins"), (0.0, 1e-8, 1e-4, 1.0, 10.0)
    stages = ("packings", "spectrum_bins")
    path = synthetic.ensemble(folder, (8, 16), (0.83, 0.86, 0.90), kts, seeds=3, stages=stages)
    with open_ensemble(path) as dataset:
        yield dataset


@pytest.mark.parametrize("name", OF_ENSEMBLES)
def test_a_figure_is_a_picture_a_vector_picture_and_its_numbers(name, whole, tmp_path):
    draw(name, whole, tmp_path / name, {})
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
        assert_array_equal(of["modes_outside"], 2.0)


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
    fine = dos.table(ensemble, Options(kt=(1e-4,), fineness=1.0))
    coarse = dos.table(ensemble, Options(kt=(1e-4,), fineness=0.1))
    assert len(fine) - len(coarse) > 500
    assert fine["modes"].sum() == coarse["modes"].sum()


def test_fineness_is_that_of_the_study_where_no_other_is_asked_for(tmp_path):
    point = synthetic.point(tmp_path, 16, 0.9, 1e-4, 2)
    chosen, bins = {"protocol": {"spectrum": {"fineness": 0.1}}}, {}
    for name, config in {"silent": {}, "0.1": chosen}.items():
        write_ensemble([point], tmp_path / f"{name}.nc", config)
        with open_ensemble(tmp_path / f"{name}.nc") as dataset:
            bins[name] = dos.table(dataset, Options())["omega"].tolist()
            for asked in (0.1, 0.2):
                bins[asked] = dos.table(dataset, Options(fineness=asked))["omega"].tolist()
    assert bins["silent"] == bins[0.2] != bins["0.1"] == bins[0.1]


def test_panels_are_those_of_the_paper_or_spread_evenly(tmp_path):
    kts = (1e-8, 1e-6, 1e-4, 1e-2, 1.0, 10.0)
    with open_ensemble(synthetic.ensemble(tmp_path, phis=(0.9,), kts=kts, seeds=1)) as dataset:
        assert list(dos.table(dataset, Options())["kt"].unique()) == [1e-8, 1e-4, 1.0, 10.0]
    with open_ensemble(synthetic.ensemble(tmp_path, phis=(0.9,), kts=kts[1:], seeds=1)) as dataset:
        assert list(dos.table(dataset, Options())["kt"].unique()) == [1e-6, 1e-4, 1.0, 10.0]


POINT = (16, 0.90, 1e-4)


def test_modes_and_bins_give_the_same_numbers(whole_ensemble, counted_ensemble):
    for kappa in (0.0, 1e-8, 1e-4, 10.0):
        point = (16, 0.90, kappa)
        bins = counted(counted_ensemble, *point)
        modes = spectrum(whole_ensemble, *point).in_bins(bins.edges)
        assert_array_equal(bins.edges, synthetic.edges(kappa))
        assert_array_equal(bins.count, modes.count)
        assert_array_equal(bins.outside, modes.outside)
        assert_allclose(bins.psi_rotational.total, modes.psi_rotational.total, atol=1e-12)
        p = modes.participation_ratio.total
        assert_allclose(bins.participation_ratio.total, p, atol=1e-12)
        assert_allclose(bins.participation_ratio.error, 0.02 * modes.count)


def test_figures_of_bins_are_those_of_the_modes_on_their_edges(whole_ensemble, counted_ensemble):
    found = participation_ratio.table(counted_ensemble, Options(kt=(1e-4,)))
    modes = spectrum(whole_ensemble, *POINT).in_bins(synthetic.edges(1e-4))
    expected = spectral_rows.of_bins(modes, POINT, "without")[list(participation_ratio.COLUMNS)]
    error = "participation_ratio_standard_error"
    pd.testing.assert_frame_equal(found.drop(columns=error), expected.drop(columns=error))
    total = np.where(found["modes"] > 0, found["modes"], np.nan)
    stated = 0.02 * np.sqrt((modes.count**2).sum(axis=0)) / total
    assert_allclose(found[error], np.fmax(expected[error], stated))
    assert (found[error] > expected[error]).any()


def test_every_density_counts_every_mode_once(whole_ensemble, counted_ensemble):
    both = (whole_ensemble, counted_ensemble)
    modules = (dos, dos_n, dos_phi, dos_frictionless)
    for table in [module.table(of, Options()) for module in modules for of in both]:
        for (n, _, kappa), of in table.groupby(["n", "phi", "kt"]):
            width = of["omega_high"] - of["omega_low"]
            vibrations = (3 if kappa else 2) * n - 2
            assert_allclose((of["density"] * width).sum(), vibrations / (3 * n))
            assert_array_equal(of["modes_outside"], 2.0)


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


def test_frictionless_grains_have_the_translational_band_alone(whole_ensemble):
    table = dos_frictionless.table(whole_ensemble, Options())
    frictional, without = (table[table["kind"] == kind] for kind in ("frictional", "frictionless"))
    assert (set(frictional["kt"]), set(without["kt"])) == ({1e-8}, {0.0})
    assert_array_equal(frictional["omega_low"], without["omega_low"])
    assert (frictional["modes"].sum(), without["modes"].sum()) == (3 * 46, 3 * 30)
    assert without.loc[without["omega"] < 0.01, "modes"].sum() == 0


def test_the_hessian_is_the_jacobian_with_tangent_stiffnesses_alone(whole_ensemble):
    table = dos_hessian.table(whole_ensemble, Options())
    assert list(table["kt"].unique()) == [1e-8, 1e-4, 1.0, 10.0]
    for kappa, of in table.groupby("kt"):
        density = of.pivot(index="omega", columns="kind", values="density")
        assert len(density) == len(synthetic.edges(kappa)) - 1
        assert_array_equal(density["hessian"], density["jacobian"])
        assert_array_equal(of.loc[of["kind"] == "hessian", "modes_outside"], 2.0)
        printed = of.loc[of["kind"] == "printed", "modes"].to_numpy()
        assert_array_equal(np.roll(printed, -1), of.loc[of["kind"] == "jacobian", "modes"])


def test_rattlers_add_their_modes(whole_ensemble):
    table = dos_rattlers.table(whole_ensemble, Options())
    assert list(table["kt"].unique()) == [1e-8, 1e-4]
    for kappa, of in table.groupby("kt"):
        modes = of.pivot(index="omega", columns="kind", values="modes")
        lone = modes.index < 0.2 * np.sqrt(kappa)
        common = ~lone & (modes.index < 1.0)
        assert_array_equal(modes["with"][common], modes["without"][common])
        assert (modes["with"][lone].sum(), modes["without"][lone].sum()) == (3, 0)
        outside = of.groupby("kind")["modes_outside"].first()
        assert (outside["with"], outside["without"]) == (4.0, 2.0)


def test_participation_ratio_is_that_with_rattlers_where_a_study_has_it(whole_ensemble):
    table = participation_ratio.table(whole_ensemble, Options(kt=(1e-4,)))
    assert set(table["kind"]) == {"with"}
    lone = table[(table["omega"] < 0.2e-2) & (table["modes"] > 0)]
    assert_allclose(lone["participation_ratio"], 1 / 16)
    modes = spectrum(whole_ensemble, *POINT, "_rattlers")
    inside = np.isfinite(modes.frequency)
    total = (table["participation_ratio"] * table["modes"]).sum()
    assert_allclose(total, modes.participation_ratio[inside].sum())


def test_points_are_those_that_have_the_data(tmp_path):
    rigidity, counts = ("packings", "rigidity"), ("packings", "spectrum_bins")
    points = [
        synthetic.point(tmp_path, 8, 0.86, 1e-8, 2),
        synthetic.point(tmp_path, 8, 0.90, 1e-8, 2),
        synthetic.point(tmp_path, 8, 0.90, 1e-4, 2),
        synthetic.point(tmp_path, 16, 0.90, 1e-8, 2, counts),
        synthetic.point(tmp_path, 24, 0.90, 0.0, 2),
        synthetic.point(tmp_path, 32, 0.90, 1e-8, 2, rigidity),
        synthetic.point(tmp_path, 8, 0.92, 1e-8, 2, rigidity),
    ]
    write_ensemble(points, tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        shown = dos.table(dataset, Options())
        assert (set(shown["n"]), set(shown["phi"]), set(shown["kt"])) == ({8}, {0.90}, {1e-8, 1e-4})
        assert list(dos.table(dataset, Options(n=16))["kt"].unique()) == [1e-8]
        assert list(dos_n.table(dataset, Options())["n"].unique()) == [8, 16]
        assert list(dos_n.table(dataset, Options(phi=0.86))["n"].unique()) == [8]
        assert list(dos_phi.table(dataset, Options())["phi"].unique()) == [0.86, 0.90]
        assert set(dos_phi.table(dataset, Options(n=16))["n"]) == {16}
        with pytest.raises(ValueError, match=r"n = 32: .* can show 8, 16"):
            dos.table(dataset, Options(n=32))
        with pytest.raises(ValueError, match="at k_T = 0 and above"):
            dos_frictionless.table(dataset, Options())


def unaveraged(folder, stage, n, kt):
    """A point whose spectra have neither psi nor p."""
    packings, spectra = (synthetic.block(of, n, 0.9, kt, range(2)) for of in ("packings", stage))
    for name in list(spectra.variables):
        if "psi" in name or "participation" in name:
            del spectra.variables[name]
    path = folder / f"{stage}-{n}-{kt}.nc"
    write_block(path, merge_blocks({"a": packings, "b": spectra}))
    return path


def test_points_whose_zero_modes_have_no_vectors_are_points_with_modes(tmp_path):
    points = [synthetic.point(tmp_path, 8, 0.9, kt, 2) for kt in (1e-8, 1e-4)]
    for path in points:  # as windows leave them
        block = read_block(path)
        for name in ("psi_rotational", "participation_ratio"):
            block.variables[name][:, :2] = np.nan
        write_block(path, block)
    points.append(synthetic.point(tmp_path, 16, 0.9, 1e-8, 2, ("packings", "spectrum_bins")))
    points.append(unaveraged(tmp_path, "spectrum_bins", 24, 1e-8))
    write_ensemble(points, tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        present = points_with(dataset, "psi_rotational")
        assert present.sel(n=8).all()
        assert not present.sel(n=24).any()
        assert set(dos.table(dataset, Options())["n"]) == {8}


def test_hessians_are_shown_where_there_is_a_jacobian_beside_them(tmp_path):
    whole = ("packings", "spectrum", "spectrum_hessian")
    points = [
        synthetic.point(tmp_path, 8, 0.90, 1e-4, 2, whole),
        synthetic.point(tmp_path, 8, 0.92, 1e-4, 2, ("packings", "spectrum_hessian")),
    ]
    write_ensemble(points, tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        table = dos_hessian.table(dataset, Options())
    assert set(table["phi"]) == {0.90}
    assert set(table["kind"]) == {"jacobian", "hessian", "printed"}
    assert (table["modes_outside"] >= 0).all()


def test_counts_alone_stand_behind_modes_and_averages(tmp_path):
    large = unaveraged(tmp_path, "spectrum_bins", 16, 1e-8)
    small = [unaveraged(tmp_path, "spectrum", 8, 1e-4), synthetic.point(tmp_path, 8, 0.9, 1e-8, 2)]
    for points, n, kts in (([large, *small], 8, [1e-8, 1e-4]), ([large], 16, [1e-8])):
        write_ensemble(points, tmp_path / "ensemble.nc", {})
        with open_ensemble(tmp_path / "ensemble.nc") as dataset:
            table = dos.table(dataset, Options())
            assert (set(table["n"]), list(table["kt"].unique())) == ({n}, kts)
            assert dos_n.table(dataset, Options())["n"].max() == 16


def test_one_sample_of_averages_has_the_error_stated_for_it(tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.9,), seeds=1, stages=("packings", "spectrum_bins"))
    with open_ensemble(path) as dataset:
        table = participation.table(dataset, Options(kt=(1e-4,)))
    filled = table[table["modes"] > 0]
    assert_allclose(filled["psi_standard_error"], 0.01)


@pytest.mark.parametrize("name", OF_ENSEMBLES)
def test_a_study_without_a_jammed_sample_still_has_its_figures(name, tmp_path):
    kts, stages = (0.0, 1e-8, 1e-4), synthetic.WHOLE
    path = synthetic.ensemble(tmp_path, phis=(0.83,), kts=kts, seeds=1, stages=stages)
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
            "phi = 0.87: of this ensemble, the figure can show 0.86, 0.9",
        ),
        ("dos", {"kt": (3.0,)}, "kt = 3.0: of this ensemble, the figure can show 1e-08"),
        ("dos", {"n": 17}, "n = 17: of this ensemble, the figure can show 16"),
        ("dos_n", {"kt": (1e-8, 1.0)}, "kt: the figure shows one value, asked for are 2"),
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
        "participation_ratio": "holds no participation_ratio",
        "dos_hessian": "holds no bin_count_hessian",
        "dos_rattlers": "holds no eigenvalue_rattlers",
        "dos_n": "holds no eigenvalue",
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
