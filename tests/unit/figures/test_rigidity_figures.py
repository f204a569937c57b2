"""The plotted moduli against those of the ensemble."""

import numpy as np
from matplotlib.figure import Figure
from numpy.testing import assert_allclose, assert_array_equal

import synthetic
from grainmodes.ensemble import open_ensemble, write_ensemble
from grainmodes.figures import draw
from grainmodes.figures.own import rigidity_exponent
from grainmodes.figures.paper_a import g_kt, g_nonaffine, g_phi
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.selection import Options


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
            assert labels.modulus_label("$G$", g_phi.table(dataset, Options())) == label


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


def test_a_mean_that_is_not_positive_is_named_instead_of_drawn(ensemble):
    table = rigidity_exponent.table(ensemble, Options())
    lowest = table.index[0]
    table.loc[lowest, "rigidity"] = -1e-4
    figure = Figure()
    rigidity_exponent.draw(figure, table)
    drawn = sum(len(bars[0].get_xdata()) for bars in figure.axes[0].containers)
    assert drawn == len(table) - 1
    text = str(rigidity_exponent.caption(table))
    assert f"φ = {table['phi'][lowest]:g} at k_T/k_N = {table['kt'][lowest]:g}" in text


def test_no_mean_is_positive(ensemble):
    table = rigidity_exponent.table(ensemble, Options()).assign(rigidity=-1.0)
    figure = Figure()
    rigidity_exponent.draw(figure, table)
    assert "No mean of G is positive" in figure.axes[0].texts[0].get_text()


def test_an_exponent_that_two_area_fractions_do_not_give_is_not_named(ensemble):
    """The axis of φ − φ_J has numbers though it spans less than a decade."""
    table = rigidity_exponent.table(ensemble, Options()).assign(exponent=np.nan)
    table["distance"] = np.where(table["phi"] == table["phi"].max(), 0.055, 0.015)
    figure = Figure()
    rigidity_exponent.draw(figure, table)
    (axes,) = figure.axes
    assert not any("beta" in text.get_text() for text in axes.get_legend().get_texts())
    figure.draw_without_rendering()
    low, high = axes.get_xlim()
    ticks = zip(axes.get_xticks(), axes.get_xticklabels(), strict=True)
    shown = [label.get_text() for tick, label in ticks if low < tick < high]
    assert shown == ["0.02", "0.05"]
