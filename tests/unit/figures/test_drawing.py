"""The four files of a figure, and what is refused before there is any."""

import time
from pathlib import Path

import matplotlib
import numpy as np
import pytest

import synthetic
from grainmodes.dataset.files import BlockError
from grainmodes.figures import draw
from grainmodes.figures.shared import labels
from grainmodes.parameters.figures import FIGURES
from pictures import numbers_of

OF_ENSEMBLES = [name for name, figure in FIGURES.items() if figure.source == "ensemble"]


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("name", OF_ENSEMBLES)
def test_a_figure_is_two_pictures_its_numbers_and_a_caption(name, whole, tmp_path):
    draw(name, whole, tmp_path / name, {})
    numbers = numbers_of(tmp_path, name)
    assert len(numbers)
    assert len(list(tmp_path.iterdir())) == 4


def test_the_same_ensemble_gives_the_same_bytes(path, tmp_path):
    for run in ("first", "second"):
        draw("g_phi", path, tmp_path / run, {})
        time.sleep(1.1)
    for suffix in (".png", ".pdf", ".csv", ".txt"):
        first, second = (tmp_path / f"{run}{suffix}" for run in ("first", "second"))
        assert first.read_bytes() == second.read_bytes()


@pytest.fixture(scope="module")
def unjammed(tmp_path_factory):
    """An ensemble without a jammed sample."""
    folder, kts = tmp_path_factory.mktemp("unjammed"), (0.0, 1e-8, 1e-4)
    return synthetic.ensemble(folder, phis=(0.83,), kts=kts, seeds=1, stages=synthetic.WHOLE)


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("name", OF_ENSEMBLES)
def test_a_study_without_a_jammed_sample_still_has_its_figures(name, unjammed, tmp_path):
    draw(name, unjammed, tmp_path / name, {})
    assert (tmp_path / f"{name}.pdf").exists()


@pytest.mark.parametrize(
    ("name", "options", "sentence"),
    [
        ("g_psi", {}, "figure: expected one of g_phi, g_kt"),
        (
            "dos",
            {"colour": "red"},
            "figure dos: unknown option 'colour', expected one of n, phi, kt",
        ),
        (
            "dos",
            {"phi": 0.87},
            r"phi: expected one of 0\.86, 0\.9 in this ensemble, got 0\.87",
        ),
        ("dos", {"kt": (3.0,)}, "kt: expected one of 1e-08, .* got 3.0"),
        ("dos", {"n": 17}, "n: expected one of 16 in this ensemble, got 17"),
        ("dos_n", {"kt": (1e-8, 1.0)}, "kt: expected one value for this figure, got 2"),
        ("dos", {"bin_density": 0.0}, "expected a bin_density from 0.01 to 1, got 0.0"),
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
        "stress_strain": "holds no curve_count",
        "rigidity_mean": "holds no curve_count",
    }.items():
        with pytest.raises(BlockError, match=sentence):
            draw(name, path, tmp_path / "figure", {})
    with pytest.raises(ValueError, match="figure g_kt: expected an ensemble with a k_T > 0"):
        draw("g_kt", path, tmp_path / "figure", {})


def test_a_figure_that_fails_half_way_leaves_the_old_one(path, tmp_path, monkeypatch):
    draw("g_phi", path, tmp_path / "figure", {})
    before = {entry.name: entry.read_bytes() for entry in tmp_path.iterdir()}

    def no_space(*_, **__):
        raise OSError("no space left on device")

    monkeypatch.setattr(Path, "write_text", no_space)
    with pytest.raises(OSError, match="no space"):
        draw("g_phi", path, tmp_path / "figure", {"kt": (1.0,)})
    assert {entry.name: entry.read_bytes() for entry in tmp_path.iterdir()} == before


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1e-8, "10^{-8}"),
        (0.0, "0"),
        (2.0, "2"),
        (0.03, r"3\times 10^{-2}"),
        (1e-2, "10^{-2}"),
        (9.9996e-5, "10^{-4}"),
        (9.994e-5, r"9.99\times 10^{-5}"),
        (0.09999, "0.09999"),
        (999.7, r"10^{3}"),
        (-3e-5, r"-3\times 10^{-5}"),
    ],
)
def test_numbers_as_formulas(value, text):
    assert labels.power(value) == text


def test_labels_of_samples_and_fractions():
    assert labels.count_samples([8, 8]) == "8 samples"
    assert labels.count_samples(np.array([6, 8])) == "6–8 samples"
    assert labels.count_samples([1]) == "1 sample"
    assert [labels.count_samples([k], "state") for k in (1, 3)] == ["1 state", "3 states"]
    assert [labels.fraction(phi) for phi in (0.9, 0.845)] == ["0.90", "0.845"]


USERS_CHOICES = {
    "text.usetex": True,
    "savefig.bbox": "tight",
    "savefig.facecolor": "black",
    "font.family": "monospace",
    "axes.facecolor": "yellow",
    "figure.dpi": 31,
    "pdf.compression": 0,
    "axes.prop_cycle": matplotlib.cycler(color=["red"]),
    "lines.linestyle": ":",
}
"""Of a matplotlibrc."""


def test_a_matplotlibrc_of_the_user_changes_no_byte(path, tmp_path):
    draw("g_phi", path, tmp_path / "ours", {})
    with matplotlib.rc_context(USERS_CHOICES):
        draw("g_phi", path, tmp_path / "theirs", {})
        assert matplotlib.rcParams["figure.dpi"] == 31, "what they chose stays theirs"
    for form in ("png", "pdf", "csv", "txt"):
        made = [(tmp_path / f"{name}.{form}").read_bytes() for name in ("ours", "theirs")]
        assert made[0] == made[1], form


@pytest.mark.parametrize(
    ("figure", "options", "sentence"),
    [
        ("nonaffine_crossing", {"kt": (1.0,)}, "expected no kt, because it shows no choice of it"),
        ("nonaffine_crossing", {"seed": 1}, "expected no seed, because it shows no choice of it"),
        ("g_phi", {"phi": 0.9}, "expected no phi, because it shows no choice of it, got 0.9"),
        ("g_phi", {"bin_density": 0.5}, "expected no bin_density"),
        ("dos", {"seed": 0}, "expected no seed"),
        ("dos", {"bin_density": 0.009}, "expected a bin_density from 0.01 to 1, got 0.009"),
    ],
)
def test_an_option_that_a_figure_does_not_use_is_refused(
    whole, tmp_path, figure, options, sentence
):
    with pytest.raises(ValueError, match=f"figure {figure}: {sentence}"):
        draw(figure, whole, tmp_path / "figure", options)
    assert not list(tmp_path.iterdir())
