"""What a figure says of samples that the scene requested and that it lacks."""

import numpy as np
import pandas as pd
import pytest

import synthetic
from edited_files import edited
from grainmodes.dataset.files import Block, read_block, write_block
from grainmodes.ensemble import open_ensemble, write_ensemble
from grainmodes.figures import draw
from grainmodes.figures.paper_c import film
from grainmodes.figures.shared import labels, missing
from grainmodes.parameters.figures import FIGURES
from pictures import numbers_of
from released import complex_pairs_block

KTS = (1e-4, 1.0)
PHIS = (0.86, 0.90)
OF_ENSEMBLES = [name for name, figure in FIGURES.items() if figure.source == "ensemble"]


def ensemble_that_lost(folder, lost: dict, stages=synthetic.STAGES, phis=PHIS, kind="failures"):
    """An ensemble of 4 samples at each point; (φ, k_T) → seeds that the first stage lost there."""
    points = []
    for phi in phis:
        for kt in KTS:
            path = synthetic.point(folder, 16, phi, kt, 4, stages)
            made, seeds = read_block(path), lost.get((phi, kt), [])
            converged = made.variables["converged"].copy()
            converged[seeds] = 0
            reasons = {stages[-1]: dict.fromkeys(map(str, seeds), "no balance")}
            config = {stage: {} for stage in stages}
            attributes = made.attributes | {"config": config} | ({kind: reasons} if seeds else {})
            write_block(path, Block(made.variables | {"converged": converged}, attributes))
            points.append(path)
    write_ensemble(points, folder / "ensemble.nc", {})
    return folder / "ensemble.nc"


def missing_lines(folder, name: str) -> list[str]:
    """What the CSV of a figure says of missing samples."""
    lines = (folder / f"{name}.csv").read_text(encoding="utf-8").splitlines()
    return [line.removeprefix("# missing: ") for line in lines if line.startswith("# missing: ")]


@pytest.mark.parametrize(("kind", "words"), [("failures", "failed"), ("not_rigid", "not rigid")])
def test_a_figure_says_seven_of_eight(tmp_path, kind, words):
    path = ensemble_that_lost(tmp_path, {(0.9, 1.0): [2]}, kind=kind)
    draw("g_phi", path, tmp_path / "g_phi", {})
    sentence = f"N = 16, φ = 0.90, k_T/k_N = 1: 3 of 4 samples (1 {words} in spectrum)"
    assert missing_lines(tmp_path, "g_phi") == [sentence]
    caption = " ".join((tmp_path / "g_phi.txt").read_text(encoding="utf-8").split())
    assert f"Missing: {sentence}." in caption
    rows = pd.read_csv(tmp_path / "g_phi.csv", comment="#")
    assert set(rows.loc[(rows["phi"] == 0.9) & (rows["kt"] == 1.0), "samples"]) == {3}


def test_what_is_missing_stands_in_the_picture(tmp_path, monkeypatch):
    below = []
    monkeypatch.setattr(labels, "write_below", lambda figure, lines: below.append(lines))
    draw("g_phi", ensemble_that_lost(tmp_path, {(0.9, 1.0): [2]}), tmp_path / "g_phi", {})
    whole = synthetic.ensemble(tmp_path)
    draw("g_phi", whole, tmp_path / "whole", {})
    assert [len(lines) for lines in below] == [1, 0]


def test_a_figure_of_other_points_says_nothing(tmp_path):
    path = ensemble_that_lost(tmp_path, {(0.86, 1.0): [2]})
    draw("dos", path, tmp_path / "dos", {"phi": 0.9})
    assert missing_lines(tmp_path, "dos") == []


def test_a_point_that_is_lost_as_a_whole_is_told_where_it_would_have_been(tmp_path):
    path = ensemble_that_lost(tmp_path, {(0.9, 1.0): [0, 1, 2, 3]})
    draw("dos", path, tmp_path / "dos", {})
    assert missing_lines(tmp_path, "dos") == [
        "N = 16, φ = 0.90, k_T/k_N = 1: 0 of 4 samples (4 failed in spectrum)"
    ]


def test_an_error_is_not_taken_for_a_lost_sample(tmp_path, monkeypatch):
    """One sample of four is lost, which explains no error of the figure."""

    def broken(ensemble, options):
        raise ValueError("broken on purpose")

    monkeypatch.setattr("grainmodes.figures.paper_a.g_phi.table", broken)
    path = ensemble_that_lost(tmp_path, {(0.9, 1.0): [2]})
    with pytest.raises(ValueError, match="broken on purpose"):
        draw("g_phi", path, tmp_path / "g_phi", {})
    assert not (tmp_path / "g_phi.png").exists()


SPECTRAL = ("participation", "dos", "dos_scaled", "dos_hessian", "dos_rattlers", "dos_phi")


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("name", [*SPECTRAL, "participation_ratio"])
def test_a_lost_point_is_not_replaced_by_another(tmp_path, name):
    """Neither another φ nor another k_T takes its place."""
    stages = ("packings", "spectrum", "spectrum_rattlers", "spectrum_hessian")
    lost = {(0.9, KTS[0]): range(4)}
    draw(name, ensemble_that_lost(tmp_path, lost, stages), tmp_path / name, {})
    (line,) = missing_lines(tmp_path, name)
    assert line.startswith("N = 16, φ = 0.90, k_T/k_N = 10⁻⁴: 0 of 4 samples")
    rows = pd.read_csv(tmp_path / f"{name}.csv", comment="#")
    expected = {0.86} if name == "dos_phi" else {0.9}
    assert set(rows["phi"]) == expected


def test_all_of_the_largest_fraction_lost_leaves_an_empty_figure(tmp_path):
    path = ensemble_that_lost(tmp_path, {(0.9, kt): range(4) for kt in KTS})
    draw("dos", path, tmp_path / "dos", {})
    assert pd.read_csv(tmp_path / "dos.csv", comment="#").empty
    assert len(missing_lines(tmp_path, "dos")) == 2


def test_a_law_that_ended_early_is_left_out_of_the_mean(tmp_path):
    stages = ("packings", "rigidity", "law_comparison")
    path = ensemble_that_lost(tmp_path, {(0.9, 1.0): [2]}, stages, (0.9,))
    draw("law_comparison", path, tmp_path / "laws", {})
    rows = pd.read_csv(tmp_path / "laws.csv", comment="#")
    assert set(rows.loc[rows["kind"] == "pairs", "samples"]) == {3}
    assert missing_lines(tmp_path, "laws")[0].endswith(
        "3 of 4 samples (1 failed in law_comparison)"
    )


def test_many_points_are_counted(tmp_path):
    path = ensemble_that_lost(tmp_path, {(phi, kt): [1] for phi in PHIS for kt in KTS})
    draw("g_phi", path, tmp_path / "g_phi", {})
    lines = missing_lines(tmp_path, "g_phi")
    assert len(lines) == 4
    assert lines[-1] == "and 1 more points with fewer samples than requested"


def test_an_average_of_sheared_samples_lacks_those_that_are_not_jammed(tmp_path):
    stages = ("packings", "rigidity", "shear")
    path = ensemble_that_lost(tmp_path, {(0.9, 1.0): [2]}, stages)
    with open_ensemble(path) as opened:
        loose = opened.load()
    loose["jammed"].loc[{"phi": 0.9, "kt": 1.0, "seed": 3}] = 0
    (shortage,) = missing.shortages("rigidity_mean", loose)
    assert str(shortage).endswith("2 of 4 samples (1 failed in shear, 1 not jammed)")
    (shortage,) = missing.shortages("g_phi", loose)
    assert str(shortage).endswith("3 of 4 samples (1 failed in shear)")


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("name", OF_ENSEMBLES)
def test_a_figure_of_which_all_samples_failed_is_an_empty_frame_that_says_why(name, tmp_path):
    phi, everything = (0.9,), {(0.9, kt): [0, 1, 2, 3] for kt in KTS}
    stages = synthetic.WHOLE
    path = ensemble_that_lost(tmp_path, everything, stages, phi)
    draw(name, path, tmp_path / name, {})
    assert (tmp_path / f"{name}.pdf").read_bytes().startswith(b"%PDF")
    lines = missing_lines(tmp_path, name)
    assert [line.partition(": ")[2] for line in lines] == [
        f"0 of 4 samples (4 failed in {stages[-1]})" for _ in KTS
    ]


def test_a_figure_without_its_variables_is_empty_only_if_they_failed(tmp_path):
    """A stage that failed for all samples leaves no variable."""
    stages = ("packings", "rigidity", "shear")
    path = ensemble_that_lost(tmp_path, {(0.9, kt): [0, 1, 2, 3] for kt in KTS}, stages, (0.9,))
    with open_ensemble(path) as opened:
        bare = opened.load().drop_vars([name for name in opened if str(name).startswith("curve_")])
    bare.to_netcdf(tmp_path / "bare.nc")
    with edited(tmp_path / "bare.nc"):
        pass
    draw("rigidity_mean", tmp_path / "bare.nc", tmp_path / "mean", {})
    assert "4 failed in shear" in missing_lines(tmp_path, "mean")[0]
    with pytest.raises(Exception, match="holds no comparison_count"):
        draw("law_comparison", tmp_path / "bare.nc", tmp_path / "laws", {})
    assert not (tmp_path / "laws.png").exists()


def test_an_empty_answer_is_no_failure(tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.83,), stages=("packings", "shear"))
    draw("rigidity_mean", path, tmp_path / "mean", {})
    assert missing_lines(tmp_path, "mean") == ["no jammed sample was sheared"]


def test_a_figure_may_have_words_of_its_own_for_an_empty_answer(tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.9,), kts=(1e-8, 1e-4))
    draw("nonaffine_crossing", path, tmp_path / "crossing", {})
    sentence = "no jammed sample at a k_T/k_N of at least 0.05"
    assert missing_lines(tmp_path, "crossing") == [sentence]


def released_block(**attributes) -> Block:
    """Two samples of the stage `release`, neither with a state to release."""
    pairs = complex_pairs_block()
    variables = {"seed": np.arange(2), "converged": np.array([1, 0])}
    made = {"stage": "release", "kt": 1.0} | attributes
    return Block(variables, pairs.attributes | made)


def test_a_film_of_nothing_is_a_frame_that_says_why(tmp_path):
    failed = {"complex_pairs": {"1": "no balance"}}
    write_block(tmp_path / "release.nc", released_block(failures=failed))
    film.write([tmp_path / "release.nc"], tmp_path / "film.gif", {})
    assert (tmp_path / "film.gif").read_bytes().startswith(b"GIF")
    draw("release_growth", [tmp_path / "release.nc"], tmp_path / "release_growth", {})
    first, second = missing_lines(tmp_path, "release_growth")
    assert first == "no sample has a complex pair that can be released"
    assert second.endswith("1 of 2 samples (1 failed in complex_pairs)")


def test_a_sample_that_failed_in_part_is_used_and_named():
    lost = {"release": {"0": "state 1: no balance"}, "complex_pairs": {"1": "no balance"}}
    (shortage,) = missing.shortages("release_outcome", [released_block(failures=lost)])
    assert str(shortage).endswith(
        "1 of 2 samples (1 failed in complex_pairs, 1 failed in release in part)"
    )


def test_nothing_missing_leaves_the_files_as_they_are(tmp_path, path):
    draw("g_phi", path, tmp_path / "g_phi", {})
    assert len(numbers_of(tmp_path, "g_phi"))
    assert missing_lines(tmp_path, "g_phi") == []
