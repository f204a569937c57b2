"""Which points a figure shows where not every point of the grid has the data."""

import numpy as np
import pytest

import synthetic
from grainmodes.dataset.files import read_block, write_block
from grainmodes.ensemble import merge_blocks, open_ensemble, write_ensemble
from grainmodes.ensemble.spectra import points_with
from grainmodes.figures.paper_a import dos, dos_frictionless, dos_hessian, dos_n, dos_phi, g_phi
from grainmodes.figures.shared.selection import Options


def test_figures_show_the_largest_n_and_spectral_ones_the_largest_phi(tmp_path):
    path = synthetic.ensemble(tmp_path, ns=(8, 16), phis=(0.86, 0.88), kts=(1.0,), seeds=2)
    with open_ensemble(path) as dataset:
        table = dos.table(dataset, Options())
        requested = dos.table(dataset, Options(n=8, phi=0.86))
        rigidity = g_phi.table(dataset, Options())
    assert (set(table["n"]), set(table["phi"])) == ({16}, {0.88})
    assert (set(requested["n"]), set(requested["phi"])) == ({8}, {0.86})
    assert (set(rigidity["n"]), set(rigidity["phi"])) == ({16}, {0.86, 0.88})


def test_spectral_figures_show_the_largest_phi_that_has_spectra(tmp_path):
    points = [
        synthetic.point(tmp_path, 16, 0.86, 1.0, 2),
        synthetic.point(tmp_path, 16, 0.90, 1.0, 2, stages=("packings", "rigidity")),
    ]
    write_ensemble(points, tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        assert set(dos.table(dataset, Options())["phi"]) == {0.86}
        with pytest.raises(ValueError, match=r"phi: expected one of 0\.86 .* got 0\.9"):
            dos.table(dataset, Options(phi=0.90))


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
        with pytest.raises(ValueError, match=r"n: expected one of 8, 16 .* got 32"):
            dos.table(dataset, Options(n=32))
        with pytest.raises(ValueError, match="at k_T = 0 and above"):
            dos_frictionless.table(dataset, Options())


def unaveraged(folder, stage, n, kt):
    """A point whose spectra have neither psi nor p."""
    packings, spectra = (synthetic.block(one, n, 0.9, kt, range(2)) for one in ("packings", stage))
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
