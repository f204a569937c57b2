"""Reference ensembles: reduced, checked, and good for figures and claims."""

import runpy
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
import yaml

import synthetic
from edited_files import edited
from grainmodes.claims import first_tested
from grainmodes.cli import main
from grainmodes.configuration import scene_from
from grainmodes.dataset.files import BlockError
from grainmodes.ensemble import reference


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("study")
    return synthetic.ensemble(folder, phis=(0.85, 0.9), kts=(0.0, 1e-4, 1.0), seeds=5)


@pytest.fixture(scope="module")
def folder(tmp_path_factory, whole) -> Path:
    """A folder of references that holds one study, `small`."""
    home = tmp_path_factory.mktemp("references")
    scene = home / "small_scene.yaml"
    scene.write_text("study: small\n")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reference, "FOLDER", home)
        reference.write_reference(scene, ["g_phi", "dos"], {"ensemble": [whole]})
    return home


def test_series_are_rounded_and_samples_are_kept(whole, folder):
    with xr.open_dataset(whole) as full, xr.open_dataset(folder / "small/ensemble.nc") as small:
        assert {**small.attrs, "checksum": ""} == {**full.attrs, "checksum": ""}
        assert set(small.variables) == set(full.variables)
        np.testing.assert_array_equal(small["g"], full["g"])
        np.testing.assert_allclose(small["eigenvalue"], full["eigenvalue"], rtol=1e-4)
        assert not np.array_equal(small["eigenvalue"], full["eigenvalue"], equal_nan=True)


def test_verdicts_are_those_of_the_whole_ensemble(whole, folder):
    kept, _ = first_tested([folder / "small/ensemble.nc"])
    full, _ = first_tested([whole])
    assert [(v.claim, v.verdict) for v in kept] == [(v.claim, v.verdict) for v in full]
    assert {v.verdict for v in kept} > {"not tested"}


def test_the_first_ensemble_that_tests_a_claim_decides_it(whole, tmp_path):
    bare = synthetic.ensemble(tmp_path, phis=(0.9,), kts=(1.0,), stages=("packings", "rigidity"))
    found = first_tested([bare, whole])[0][7]
    assert found.verdict == first_tested([whole])[0][7].verdict
    assert found.explanation.startswith(f"Ensemble {whole.parent.name}: ")


def test_what_a_claim_lacks_is_that_of_the_ensemble_with_parts_of_it(whole, tmp_path):
    """A1 lacks damped dynamics in `whole`, and everything in an ensemble of packings alone."""
    bare = synthetic.ensemble(tmp_path, phis=(0.9,), kts=(1.0,), stages=("packings", "rigidity"))
    needed = first_tested([whole])[0][0].needed
    assert "g_forward_damped" in needed
    for paths in ([bare, whole], [whole, bare]):
        assert first_tested(paths)[0][0].needed == needed


def test_a_changed_file_is_refused(folder, tmp_path, monkeypatch):
    (tmp_path / "small").mkdir()
    (tmp_path / reference.INDEX).write_text((folder / reference.INDEX).read_text())
    (tmp_path / "small/ensemble.nc").write_bytes(
        (folder / "small/ensemble.nc").read_bytes()[:-1] + b"?"
    )
    monkeypatch.setattr(reference, "FOLDER", tmp_path)
    one = reference.reference_named("small")
    with pytest.raises(BlockError, match="expected the SHA-256"):
        reference.files_of(one, "ensemble")
    with pytest.raises(BlockError, match="holds no fields"):
        reference.files_of(one, "fields")


def test_the_commands_use_it(folder, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(reference, "FOLDER", folder)
    assert main(["figure", "g_phi", "--reference", "-o", str(tmp_path / "g")]) == 0
    assert (tmp_path / "g.png").is_file()
    assert main(["claims", "--reference", "small"]) == 0
    assert "A2" in capsys.readouterr().out
    assert main(["claims", "--reference", "large"]) == 1
    assert "expected one of small, got 'large'" in capsys.readouterr().err
    assert main(["figure", "g_phi", "x.nc", "--reference", "-o", str(tmp_path / "g")]) == 1
    assert "expected either files or --reference" in capsys.readouterr().err
    assert main(["figure", "pair_birth", "--reference", "-o", str(tmp_path / "g")]) == 1
    assert "no reference ensemble draws the figure pair_birth" in capsys.readouterr().err


def test_the_references_of_the_package_are_whole():
    for one in reference.references().values():
        for source in one.files:
            assert reference.files_of(one, source)


def test_an_interruption_leaves_the_old_reference(folder, whole, monkeypatch):
    monkeypatch.setattr(reference, "FOLDER", folder)
    before = (folder / "small/ensemble.nc").read_bytes()
    monkeypatch.setattr(reference, "_copy", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        reference.write_reference(folder / "small_scene.yaml", ["dos"], {"ensemble": [whole]})
    assert (folder / "small/ensemble.nc").read_bytes() == before


SCRIPT = Path(__file__).parents[3] / "workflow/scripts/reference.py"
SCENE = """
study: tiny
grids: [{n: [16], phi: [0.9], kt: [1.0], seeds: 2, observables: {spectrum: none, fields: true}}]
figures: [g_phi, affine_fields]
"""


def test_only_a_finished_study_becomes_a_reference(whole, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(reference, "FOLDER", tmp_path / "references")
    make = runpy.run_path(str(SCRIPT))["main"]
    with pytest.raises(SystemExit, match="expected CONFIG="):
        make([])
    with pytest.raises(SystemExit, match=r"tiny\.yaml: No such file"):
        make(["tiny.yaml"])
    Path("tiny.yaml").write_text(SCENE)
    pictures = [
        f"figures/{name}.{form}"
        for name in ("g_phi", "affine_fields")
        for form in ("png", "pdf", "csv", "txt")
    ]
    sample = "fields/n~16/phi~0.9/kt~1.0.nc"
    for name in ("ensemble.nc", sample, "checks.txt", "claims.md", *pictures):
        file = Path("results/tiny") / name
        with pytest.raises(SystemExit, match=f"expected a finished study, got no {file}"):
            make(["tiny.yaml"])
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(whole.read_bytes())
    with pytest.raises(SystemExit, match="got those of another one"):
        make(["tiny.yaml"])
    with edited("results/tiny/ensemble.nc") as ensemble:
        ensemble.config = scene_from(yaml.safe_load(SCENE)).summary()
    stray = Path("results/tiny/fields/n~32/phi~0.9/kt~1.0.nc")
    stray.parent.mkdir(parents=True)
    stray.write_bytes(whole.read_bytes())
    make(["tiny.yaml"])
    assert "references/tiny: " in capsys.readouterr().out
    assert list(reference.reference_named("tiny").files["fields"]) == ["fields_0.nc"]
