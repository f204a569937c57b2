"""A tiny study, built once and copied for each test, in a scratch copy of the checkout.

Snakemake reads the copy, so that a test can edit a source and ask what would run again; the jobs
run the installed package, whose compiled kernels are at hand.
"""

from __future__ import annotations

import hashlib
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

CHECKOUT = Path(__file__).parents[2]

SCENE = {
    "study": "tiny",
    "grids": [{"n": [16], "phi": [0.8, 0.85], "kt": [1e-4, 1.0], "seeds": 2}],
    "seeds_per_job": 2,
    "protocol": {"compression": {"phi_step": 0.01}},
    "figures": ["g_phi", "dos"],
}

INSTALLED = [str(Path(sys.executable).with_name("snakemake"))]
"""Snakemake as a user calls it: it tracks the sources of the installed package."""

COPIED = [
    *(sys.executable, "-c"),
    "import sys; sys.path.insert(0, 'src'); from snakemake.cli import main; main()",
]
"""Snakemake that tracks the copied sources."""


class Study:
    """A scratch copy of the checkout with the scene of `config/tiny.yaml`."""

    def __init__(self, folder: Path, launcher: list[str] = COPIED) -> None:
        self.folder = folder
        self.launcher = launcher
        self.results = folder / "results" / "tiny"

    def write_scene(self, scene: dict) -> None:
        """Replace the scene."""
        text = yaml.safe_dump(scene)
        (self.folder / "config" / "tiny.yaml").write_text(text, encoding="utf-8")

    def command(self, *words: str) -> list[str]:
        """Snakemake on the scene."""
        return [*self.launcher, *words, "-j2", "--configfile", "config/tiny.yaml"]

    def run(self, *words: str, succeeds: bool = True) -> str:
        """What Snakemake says."""
        run = subprocess.run(
            self.command(*words),
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=900,
        )
        assert (run.returncode == 0) == succeeds, run.stdout
        return run.stdout

    def planned(self, *words: str) -> dict[str, int]:
        """Rule → number of jobs that would run."""
        return jobs_in(self.run("-n", *words))

    def edit(self, source: str) -> None:
        """Change a source of the package without changing what it does."""
        path = self.folder / "src" / "grainmodes" / source
        path.write_text(path.read_text(encoding="utf-8") + "# edited\n", encoding="utf-8")

    def fingerprints(self) -> dict[str, str]:
        """Result → hash of its bytes."""
        files = (path for path in self.results.rglob("*") if path.is_file())
        return {
            path.relative_to(self.results).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in files
        }


def jobs_in(plan: str) -> dict[str, int]:
    """Rule → number of jobs, from what a dry run says."""
    jobs = re.findall(r"^(\w+) +(\d+)$", plan, re.MULTILINE)
    return {rule: int(count) for rule, count in jobs if rule not in ("all", "total")}


def copy_of(folder: Path, target: Path) -> Study:
    """Another study, with the same files and the same times of change."""
    shutil.copytree(folder, target, ignore=shutil.ignore_patterns("__pycache__"))
    return Study(target)


@pytest.fixture(scope="session")
def checkout(tmp_path_factory) -> Path:
    """What Snakemake needs of the checkout, and the tiny scene; never run."""
    folder = tmp_path_factory.mktemp("checkout")
    for name in ("workflow", "config", "src", "measurements"):
        shutil.copytree(
            CHECKOUT / name,
            folder / name,
            ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"),
        )
    shutil.copy2(CHECKOUT / "Snakefile", folder)
    Study(folder).write_scene(SCENE)
    return folder


@pytest.fixture(scope="session")
def built(checkout, tmp_path_factory) -> Study:
    """The tiny study, run without a break; tests only look at it."""
    study = copy_of(checkout, tmp_path_factory.mktemp("built") / "study")
    study.run()
    return study


@pytest.fixture
def study(built, tmp_path) -> Study:
    """A copy of the built study."""
    return copy_of(built.folder, tmp_path / "study")


@pytest.fixture
def fresh(checkout, tmp_path) -> Study:
    """The study before its first run."""
    return copy_of(checkout, tmp_path / "study")
