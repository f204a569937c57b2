"""Figures of paper C: each states Coulomb's μ and k_T/k_N, in the picture and in its caption."""

from importlib import import_module

import pytest
from matplotlib.figure import Figure

import synthetic
from grainmodes.dataset.files import write_block
from grainmodes.ensemble import open_ensemble, write_ensemble
from grainmodes.figures import draw
from grainmodes.figures.shared.sample_files import read_samples
from grainmodes.figures.shared.selection import Options
from grainmodes.parameters.figures import FIGURES
from grainmodes.parameters.release import Release
from grainmodes.stages.release import release_block
from pictures import caption_of
from released import complex_pairs_block, state

OF_C = [name for name, figure in FIGURES.items() if figure.room == "paper_c"]
LAW = {"normal": "hertz", "tangential": "smoothed_coulomb", "friction_coefficient": 10.0}
CHOICES = Release(duration=22.0, min_time=0.0, dampings=(1.0,), n_records=300, spectra=2)


@pytest.fixture(scope="module")
def ensemble(tmp_path_factory):
    """Ten grains and sixteen under C's law, at its k_T/k_N."""
    folder = tmp_path_factory.mktemp("ensemble")
    stages = ("packings", "complex_pairs", "law_comparison")
    points = [synthetic.point(folder, n, 0.9, 2.0 / 7.0, 2, stages) for n in (8, 16)]
    write_ensemble(points, folder / "ensemble.nc", {"contact_law": LAW})
    return folder / "ensemble.nc"


@pytest.fixture(scope="module")
def releases(tmp_path_factory):
    path = tmp_path_factory.mktemp("release") / "release.nc"
    write_block(path, release_block(complex_pairs_block(), state()[1], CHOICES))
    return [path]


def words_of(name: str, data) -> str:
    """All that stands above the picture of a figure."""
    module = import_module(f"grainmodes.figures.paper_c.{name}")
    figure = Figure()
    if FIGURES[name].source == "ensemble":
        with open_ensemble(data) as opened:
            module.draw(figure, module.table(opened, Options()))
    else:
        module.draw(figure, module.table(read_samples(data, "release"), Options()))
    return figure.get_suptitle()


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("name", OF_C)
def test_the_friction_coefficient_stands_in_the_picture_and_in_the_caption(
    name, ensemble, releases, tmp_path
):
    from_ensemble = FIGURES[name].source == "ensemble"
    data = ensemble if from_ensemble else releases
    words = words_of(name, data)
    assert r"$\mu = 10$" in words
    assert "0.2857" not in words
    assert not from_ensemble or "$k_T / k_N = 2/7$" in words
    draw(name, data, tmp_path / name, {})
    assert "μ = 10" in caption_of(tmp_path, name)[2]
