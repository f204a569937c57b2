"""No failure is invisible: each stage breaks for one sample, and we look in four places.

These are the attribute `failures` of the ensemble, checks.txt, the figure, and the page of claims:
a reader takes figures and verdicts away from a study, and both rest on the samples that are left.

Every stage breaks at a point of its own, so that one ensemble holds them all.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import netCDF4
import pytest

from grainmodes.cli import main
from grainmodes.dataset.files import Block, write_block
from grainmodes.ensemble import gather_point, open_ensemble, write_ensemble
from grainmodes.ensemble.lost import lost_samples
from grainmodes.figures import draw
from grainmodes.parameters.compression import Compression, FrictionalCompression
from grainmodes.parameters.figures import FIGURES
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.stages import STAGES
from grainmodes.parameters.strain import Shear
from grainmodes.stages import load
from grainmodes.stages.frictional_compression import (
    frictional_compress_block,
    frictional_packing_block,
)

from .conftest import CHECKOUT, SCENE

N, PHI, SEEDS = 16, 0.9, range(2)
REASON = "broken on purpose"
PROTOCOL = Protocol(
    compression=Compression(phi_step=0.01), shear=Shear(strain=1e-3, step=1e-4, min_step=1e-5)
)
OBSERVABLES = {"spectrum": "modes", "coarse_run": False}


class Break(NamedTuple):
    """What is broken in a stage, where a reader would see it, and what that figure also needs."""

    function: str
    figure: str | None
    needs: tuple[str, ...] = ()


BREAKS = {
    "compress": Break("place_at_random", "g_phi", ("rigidity",)),
    "equilibrate": Break("compress_to", "g_phi", ("rigidity",)),
    "compress_with_friction": Break("place_at_random", "g_phi", ("rigidity",)),
    "equilibrate_with_friction": Break("compress_to", "g_phi", ("rigidity",)),
    "rigidity": Break("rigidity", "g_phi"),
    "step_strain": Break("step_strain", "g_phi", ("rigidity",)),
    "spectrum": Break("full_spectrum", "dos"),
    "spectrum_rattlers": Break("full_spectrum", "dos_rattlers", ("spectrum",)),
    "spectrum_hessian": Break("average_in_bins", "dos_hessian", ("spectrum",)),
    "claim_diagnostics": Break("hessian_difference", None),
    "shear": Break("bracket_first_event", "rigidity_mean"),
    "complex_pairs": Break("tracking_row", "pair_birth"),
    "release": Break("unstable_state", "release_growth", ("complex_pairs",)),
    "law_comparison": Break("shear_under_all_laws", "law_comparison"),
    "fields": Break("nonaffine_field", "affine_fields"),
    "event_detail": Break("bracket_first_event", "event_states"),
}
"""Stage → how it breaks."""


def break_first_call(monkeypatch, stage: str) -> None:
    """Let the function of a stage fail when it is called for the first time."""
    module = import_module(STAGES[stage].function.partition(":")[0])
    whole, calls = getattr(module, BREAKS[stage].function), []

    def broken(*arguments, **keywords):
        calls.append(arguments)
        if len(calls) == 1:
            raise ArithmeticError(REASON)
        return whole(*arguments, **keywords)

    monkeypatch.setattr(module, BREAKS[stage].function, broken)


def law_of(stage: str) -> ContactLaw:
    """The contact law of the point at which a stage breaks."""
    return ContactLaw("hertz", "smoothed_coulomb", 1.0 + list(BREAKS).index(stage), 0.5)


def compressed(friction: bool, law: ContactLaw, breaking: Callable[[str], None]) -> Block:
    """Packings of all seeds."""
    suffix = "_with_friction" if friction else ""
    first, last = (STAGES[f"{name}{suffix}"] for name in ("compress", "equilibrate"))
    keywords = first.keywords(PROTOCOL, OBSERVABLES)
    keywords |= {"law": law} if friction else {"normal": law.normal}
    breaking(first.name)
    start = load(first.function)(n=N, seeds=SEEDS, phi=PHI, start=None, **keywords)
    breaking(last.name)
    return load(last.function)(start=start, phi=PHI, **keywords)


@cache
def whole_packings() -> Block:
    """Packings of which none is lost."""
    return compressed(False, ContactLaw(), lambda stage: None)


def blocks_with_broken(stage: str) -> dict[str, Block]:
    """The blocks of a point of which a stage has broken for the first sample."""
    law, entry = law_of(stage), STAGES[stage]
    with pytest.MonkeyPatch.context() as monkeypatch:

        def breaking(name: str) -> None:
            if name == stage:
                break_first_call(monkeypatch, stage)

        if entry.observable:
            packings = whole_packings()
        else:
            packings = compressed(entry.needs_friction, law, breaking)
        made = {"packings": packings}
        for name in (*BREAKS[stage].needs, *([stage] if entry.observable else [])):
            needed = STAGES[name]
            read = made["packings" if needed.reads == "equilibrate" else needed.reads]
            if name == "release":  # none of so few grains has a pair that grows
                read.variables["unstable_found"][0] = 1
            breaking(name)
            keywords = needed.keywords(PROTOCOL, OBSERVABLES | {"coarse_run": stage == "shear"})
            made[name] = load(needed.function)(read, law, **keywords)
        return made


@pytest.fixture(scope="module")
def broken(tmp_path_factory) -> Path:
    """A folder with the blocks of every point, the ensemble, checks.txt and the page of claims."""
    folder = tmp_path_factory.mktemp("broken")
    points = []
    for stage in BREAKS:
        paths = []
        for name, block in blocks_with_broken(stage).items():
            paths.append(folder / f"{stage}-{name}.nc")
            write_block(paths[-1], block)
        points.append(folder / f"{stage}.nc")
        write_block(points[-1], gather_point(paths))
    config = {"study": "broken", "protocol": {"compression": {"force_tolerance": 1e-14}}}
    write_ensemble(points, folder / "ensemble.nc", config)
    ended = checked(folder)
    assert ended.returncode == 1, ended.stdout
    assert main(["claims", str(folder / "ensemble.nc"), "-o", str(folder / "claims.md")]) == 0
    return folder


def checked(folder: Path) -> subprocess.CompletedProcess:
    """Run the checks of the ensemble in a folder, as the rule does."""
    return subprocess.run(
        [
            *(sys.executable, "-m", "pytest", "-p", "no:cacheprovider"),
            "workflow/checks/test_ensemble.py",
            *("--ensemble", folder / "ensemble.nc", "--report", folder / "checks.txt"),
        ],
        cwd=CHECKOUT,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def test_every_stage_is_broken_once():
    assert list(BREAKS) == list(STAGES), "a new stage breaks here too"


@pytest.mark.parametrize("stage", BREAKS)
def test_the_ensemble_holds_the_failure(broken, stage):
    kt, output = law_of(stage).kt, STAGES[stage].output
    with open_ensemble(broken / "ensemble.nc") as opened:
        (found,) = (sample for sample in lost_samples(opened) if sample.kt == kt)
    assert (found.kind, found.stage, found.n, found.phi, found.seed) == (
        "failures",
        output,
        N,
        PHI,
        0,
    )
    assert REASON in found.reason


@pytest.mark.parametrize("stage", BREAKS)
def test_the_checks_name_it(broken, stage):
    report = (broken / "checks.txt").read_text(encoding="utf-8")
    output = STAGES[stage].output.replace("_", " ")
    head = f"failed  no sample failed[{output}]: "
    (section,) = (part for part in report.split("\n") if part.startswith(head))
    below = report.partition(section)[2].partition("\npassed")[0]
    assert f"n = 16, phi = 0.9, kt = {law_of(stage).kt:g}, seed 0: " in below
    assert REASON in below


@pytest.mark.parametrize("stage", [stage for stage in BREAKS if BREAKS[stage].figure])
def test_its_figure_says_one_of_two(broken, stage, tmp_path):
    name, kt = BREAKS[stage].figure, law_of(stage).kt
    source = FIGURES[name].source
    data = broken / "ensemble.nc" if source == "ensemble" else [broken / f"{stage}-{source}.nc"]
    draw(name, data, tmp_path / name, {} if source != "ensemble" else {"kt": (kt,)})
    text = (tmp_path / f"{name}.csv").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.startswith("# missing: ")]
    left = "0 of 1 sample" if STAGES[stage].single_sample else "1 of 2 samples"
    words = f"{left} (1 failed in {STAGES[stage].output})"
    assert any(line.endswith(words) and f"k_T/k_N = {kt:g}:" in line for line in lines), lines


@pytest.mark.parametrize("stage", BREAKS)
def test_the_page_of_claims_names_it(broken, stage):
    page = (broken / "claims.md").read_text(encoding="utf-8")
    assert f"failed in {STAGES[stage].output} (" in page.partition("\n\n|")[0]


@pytest.mark.parametrize(("jammed", "result"), [(0, "passed"), (1, "failed")])
def test_grains_that_creep_below_jamming_are_no_failure(tmp_path, jammed, result):
    """Compressed with friction they never come to rest; those that carry a load do."""
    law = ContactLaw("hertz", "smoothed_coulomb", 1e-2, 0.1)
    choices = law, Compression(phi_step=0.01), FrictionalCompression(max_steps=200)
    start = frictional_compress_block(N, range(2), 0.8, *choices, None)
    packings = frictional_packing_block(start, 0.8, *choices)
    assert (packings.variables["max_force"] > 1e-10).all()
    assert not packings.variables["jammed"].any()
    packings.variables["jammed"][:] = jammed
    write_block(tmp_path / "packings.nc", packings)
    write_block(tmp_path / "point.nc", gather_point([tmp_path / "packings.nc"]))
    config = {"study": "creep", "protocol": {"compression": {"force_tolerance": 1e-14}}}
    write_ensemble([tmp_path / "point.nc"], tmp_path / "ensemble.nc", config)
    checked(tmp_path)
    assert f"{result}  forces balance" in (tmp_path / "checks.txt").read_text(encoding="utf-8")


STUMBLE = """
    if number == 1:
        raise ArithmeticError("broken on purpose")
"""


def test_a_study_with_a_broken_stage_ends_whole_and_says_so(study, monkeypatch):
    """Whole: every figure is there, and the checks; it says so: its exit status is not 0."""
    monkeypatch.setenv("PYTHONPATH", str(study.folder / "src"))
    source = study.folder / "src" / "grainmodes" / "stages" / "spectrum.py"
    text = source.read_text(encoding="utf-8")
    start = "    def sample(number: int) -> dict[str, object]:\n"
    body = STUMBLE.strip("\n").replace("\n", "\n    ")
    source.write_text(text.replace(start, f"{start}    {body}\n", 1), encoding="utf-8")
    said = study.run(succeeds=False)
    assert "Checks have failed: see results/tiny/checks.txt." in said
    files = {name for name in study.fingerprints() if name.startswith("figures/")}
    assert files == {
        f"figures/{name}.{form}"
        for name in SCENE["figures"]
        for form in ("png", "pdf", "csv", "txt")
    }
    checks = (study.results / "checks.txt").read_text(encoding="utf-8")
    assert "failed  no sample failed[spectrum]: 4 failed" in checks
    with netCDF4.Dataset(study.results / "ensemble.nc") as ensemble:
        assert len(json.loads(ensemble.failures)["spectrum"]) == 4
    for name in SCENE["figures"]:
        drawn = (study.results / "figures" / f"{name}.csv").read_text(encoding="utf-8")
        assert "1 of 2 samples (1 failed in spectrum)" in drawn
    assert "4 failed in spectrum" in (study.results / "claims.md").read_text(encoding="utf-8")
    assert not (study.results / "checks.passed").exists()
    assert study.planned() == {"passed": 1}
