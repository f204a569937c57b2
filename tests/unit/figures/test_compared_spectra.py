"""Spectra beside another: without friction, of the Hessian, with rattlers."""

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

import synthetic
from grainmodes.ensemble import open_ensemble, write_ensemble
from grainmodes.ensemble.spectra import spectrum
from grainmodes.figures.paper_a import (
    dos_frictionless,
    dos_hessian,
    dos_rattlers,
    participation_ratio,
)
from grainmodes.figures.shared.selection import Options


def test_frictionless_grains_have_the_translational_band_alone(whole_ensemble):
    table = dos_frictionless.table(whole_ensemble, Options())
    frictional, without = (table[table["kind"] == kind] for kind in ("frictional", "frictionless"))
    assert (set(frictional["kt"]), set(without["kt"])) == ({1e-8}, {0.0})
    assert_array_equal(frictional["omega_low"], without["omega_low"])
    assert (frictional["modes"].sum(), without["modes"].sum()) == (3 * 46, 3 * 30)
    assert without.loc[without["omega"] < 0.01, "modes"].sum() == 0


def test_the_rotational_band_is_shown_beside_frictionless_modes_that_were_counted(tmp_path):
    counted, known = ("packings", "spectrum_bins"), ("packings", "spectrum")
    points = [
        synthetic.point(tmp_path, 16, 0.9, 0.0, 3, stages=counted),
        synthetic.point(tmp_path, 16, 0.9, 1e-8, 3, stages=known),
    ]
    write_ensemble(points, tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        table = dos_frictionless.table(dataset, Options())
    frictional, without = (table[table["kind"] == kind] for kind in ("frictional", "frictionless"))
    assert (frictional["modes"].sum(), without["modes"].sum()) == (3 * 46, 3 * 30)
    assert frictional.loc[frictional["omega"] < 1e-3, "modes"].sum() == 3 * 16
    assert (frictional["omega_high"] > frictional["omega_low"]).all()
    assert set(without["omega_low"]) <= set(frictional["omega_low"])


def test_the_hessian_is_the_jacobian_with_tangent_stiffnesses_alone(whole_ensemble):
    table = dos_hessian.table(whole_ensemble, Options())
    assert list(table["kt"].unique()) == [1e-8, 1e-4, 1.0, 10.0]
    for kt, rows in table.groupby("kt"):
        density = rows.pivot(index="omega", columns="kind", values="density")
        assert len(density) == len(synthetic.edges(kt)) - 1
        assert_array_equal(density["hessian"], density["jacobian"])
        assert_array_equal(rows.loc[rows["kind"] == "hessian", "modes_outside"], 2.0)
        printed = rows.loc[rows["kind"] == "printed", "modes"].to_numpy()
        assert_array_equal(np.roll(printed, -1), rows.loc[rows["kind"] == "jacobian", "modes"])


def test_rattlers_add_their_modes(whole_ensemble):
    table = dos_rattlers.table(whole_ensemble, Options())
    assert list(table["kt"].unique()) == [1e-8, 1e-4]
    for kt, rows in table.groupby("kt"):
        modes = rows.pivot(index="omega", columns="kind", values="modes")
        lone = modes.index < 0.2 * np.sqrt(kt)
        common = ~lone & (modes.index < 1.0)
        assert_array_equal(modes["with"][common], modes["without"][common])
        assert (modes["with"][lone].sum(), modes["without"][lone].sum()) == (3, 0)
        outside = rows.groupby("kind")["modes_outside"].first()
        assert (outside["with"], outside["without"]) == (4.0, 2.0)


def test_participation_ratio_is_that_with_rattlers_where_a_study_has_it(whole_ensemble):
    table = participation_ratio.table(whole_ensemble, Options(kt=(1e-4,)))
    assert set(table["kind"]) == {"with"}
    lone = table[(table["omega"] < 0.2e-2) & (table["modes"] > 0)]
    assert_allclose(lone["participation_ratio"], 1 / 16)
    modes = spectrum(whole_ensemble, 16, 0.90, 1e-4, "_rattlers")
    inside = np.isfinite(modes.frequency)
    total = (table["participation_ratio"] * table["modes"]).sum()
    assert_allclose(total, modes.participation_ratio[inside].sum())
