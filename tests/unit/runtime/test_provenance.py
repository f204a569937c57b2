"""Which files stand behind a stage, and when a fingerprint changes."""

import ast
import os
import subprocess
import sys
import tempfile

import pytest

from grainmodes.runtime import environment, provenance

STAGES = {
    "compress": "grainmodes.stages.compression:compress_block",
    "equilibrate": "grainmodes.stages.compression:packing_block",
    "rigidity": "grainmodes.stages.rigidity:rigidity_block",
    "step_strain": "grainmodes.stages.step_strain:step_strain_block",
    "spectrum": "grainmodes.stages.spectrum:spectrum_block",
    "fields": "grainmodes.stages.fields:fields_block",
    "point": "grainmodes.ensemble:gather_point",
    "ensemble": "grainmodes.ensemble:write_ensemble",
    "figure": "grainmodes.figures",
}

MODULES = sorted(provenance.PACKAGE.rglob("*.py"))

TOY = {
    "__init__.py": "__version__ = '1'",
    "parameters/__init__.py": "",
    "parameters/law.py": "",
    "kernels/__init__.py": "",
    "kernels/pair.py": "from grainmodes.parameters import law",
    "left.py": "from grainmodes.kernels import pair",
    "right.py": "import grainmodes.lazy",
    "lazy.py": "def f():\n    from grainmodes.drawing.style import ink\n",
    "drawing/__init__.py": "",
    "drawing/style.py": "",
    "drawing/house.mplstyle": "",
    "blocks.py": (
        "from grainmodes.left import a\n"
        "from grainmodes import right as r\n"
        "LIMIT = r.limit\n"
        "def left_block(): return helper()\n"
        "def helper(): return a\n"
        "def right_block(): return LIMIT\n"
        "def lone_block(): return 1\n"
        "def hidden_block():\n    from grainmodes import left\n    return left\n"
    ),
}


@pytest.fixture
def toy(tmp_path, monkeypatch):
    """A package of a few files in the place of the real one."""
    package = tmp_path / "src" / "grainmodes"
    for name, text in TOY.items():
        path = package / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.setattr(provenance, "PACKAGE", package)
    return package


def names(*entries: str) -> set[str]:
    found = provenance.stage_sources(*entries)
    return {path.relative_to(provenance.PACKAGE).as_posix() for path in found}


LEFT = {"__init__.py", "blocks.py", "left.py", "kernels/__init__.py", "kernels/pair.py"}
LAW = {"parameters/__init__.py", "parameters/law.py"}
RIGHT = {"__init__.py", "blocks.py", "right.py", "lazy.py"}
DRAWING = {"drawing/__init__.py", "drawing/style.py", "drawing/house.mplstyle"}


@pytest.mark.parametrize(
    ("entry", "expected"),
    [
        ("blocks:left_block", LEFT | LAW),
        ("blocks:right_block", RIGHT | DRAWING),
        ("blocks:lone_block", {"__init__.py", "blocks.py"}),
        ("blocks:hidden_block", LEFT | LAW),
        ("blocks", LEFT | RIGHT | DRAWING | LAW),
        ("drawing", {"__init__.py", "drawing/__init__.py", "drawing/house.mplstyle"}),
    ],
)
def test_a_stage_counts_what_it_reaches(toy, entry, expected):
    assert names(f"grainmodes.{entry}") == expected


def test_entries_add_up(toy):
    both = names("grainmodes.left", "grainmodes.drawing.style")
    assert both == names("grainmodes.left") | names("grainmodes.drawing.style")


def test_entries_are_checked(toy):
    with pytest.raises(
        ModuleNotFoundError, match=r"expected a module in .*grainmodes, got grainmodes\.nowhere"
    ):
        provenance.stage_sources("grainmodes.nowhere")
    with pytest.raises(AttributeError, match="expected a definition of nothing"):
        provenance.stage_sources("grainmodes.blocks:nothing")


@pytest.mark.parametrize(
    ("edited", "compiles_anew"),
    [("kernels/pair.py", True), ("parameters/law.py", True), ("left.py", False)],
)
def test_fingerprints_follow_the_text(toy, edited, compiles_anew):
    before = provenance.source_hash(), provenance.kernel_hash()
    (toy / edited).write_text("# edited")
    after = provenance.source_hash(), provenance.kernel_hash()
    assert before[0] != after[0]
    assert (before[1] != after[1]) == compiles_anew


def test_a_moved_line_between_files_is_seen(toy):
    before = provenance.source_hash()
    (toy / "left.py").write_text("")
    (toy / "lazy.py").write_text(TOY["left.py"])
    assert provenance.source_hash() != before


def test_the_compressor_does_not_depend_on_what_comes_later():
    files = names(STAGES["compress"])
    assert {"kernels/fire.py", "protocols/compression/trajectory.py", "packing/state.py"} <= files
    assert not any(file.startswith(("spectrum", "figures", "ensemble", "cli")) for file in files)
    assert "response/moduli.py" not in files


def test_figures_stand_alone():
    """No stage but the figures reads the code of figures, so that editing it redraws them only."""
    for stage, entry in STAGES.items():
        drawn = [file for file in names(entry) if file.startswith("figures/")]
        assert bool(drawn) == (stage == "figure")


@pytest.mark.parametrize(
    "stage", ["rigidity", "step_strain", "spectrum", "fields", "compress", "equilibrate"]
)
def test_every_computing_stage_counts_the_kernels_it_calls(stage):
    assert {"kernels/laws/elastic.py", "kernels/compiler.py", "dataset/files.py"} <= names(
        STAGES[stage]
    )


def test_imports_are_absolute():
    """The static walk follows absolute imports only."""
    trees = {path: ast.parse(path.read_text(encoding="utf-8")) for path in MODULES}
    imports = [(path, node) for path, tree in trees.items() for node in ast.walk(tree)]
    relative = [path for path, node in imports if getattr(node, "level", 0)]
    assert len(MODULES) > 100 and not relative


def test_only_kernels_are_compiled():
    """The cache of compiled kernels is named by the kernels' text, so nothing else may compile."""
    texts = {path: path.read_text(encoding="utf-8") for path in MODULES}
    words = ("import numba", "from numba", "kernels.compiler")
    naming = {path for path, text in texts.items() if any(word in text for word in words)}
    assert naming and all("kernels" in path.parts for path in naming)


def test_kernels_freeze_nothing_that_their_fingerprint_leaves_out():
    known = LAW | {
        "__init__.py",
        "runtime/__init__.py",
        "runtime/environment.py",
        "runtime/provenance.py",
    }
    for path in (provenance.PACKAGE / "kernels").glob("*.py"):
        reached = names(f"grainmodes.kernels.{path.stem}".removesuffix(".__init__"))
        assert {name for name in reached if not name.startswith("kernels/")} <= known


def test_the_cache_is_named_by_the_kernels(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    once = environment.numba_cache()
    assert once == tmp_path / provenance.kernel_hash()
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(once))
    assert environment.numba_cache() == once


def test_the_cache_lies_in_the_checkout_or_with_the_user(tmp_path, monkeypatch):
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    checkout = provenance.PACKAGE.parents[1]
    assert environment.numba_cache().parent == checkout / ".numba_cache"
    monkeypatch.setattr(environment, "PACKAGE", tmp_path / "lib" / "grainmodes")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert environment.numba_cache().parent == tmp_path / "grainmodes"


NOWHERE = "/dev/null/grainmodes"
"""A folder that nobody can make, whatever the rights of who runs the tests."""


@pytest.mark.parametrize("requested", [NOWHERE, ""])
def test_without_a_writable_folder_kernels_are_kept_in_a_temporary_one(
    tmp_path, monkeypatch, capsys, requested
):
    monkeypatch.setenv("NUMBA_CACHE_DIR", requested)
    monkeypatch.setenv("HOME", NOWHERE)
    monkeypatch.setenv("XDG_CACHE_HOME", "")
    monkeypatch.setattr(environment, "PACKAGE", tmp_path / "lib" / "grainmodes")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    found = environment.numba_cache()
    assert found.parent.parent == tmp_path
    assert found.parent.stat().st_mode & 0o077 == 0, "who writes code here runs it"
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("grainmodes: expected a writable folder for compiled kernels, got /dev")
    assert line.endswith(f"; they are kept in {found}")
    assert environment.numba_cache() == found, "and so do the processes of this one"
    assert capsys.readouterr().err == ""


def test_a_temporary_folder_that_others_can_write_is_not_trusted(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", NOWHERE)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    shared = tmp_path / f"grainmodes-{os.getuid()}"
    shared.mkdir()
    shared.chmod(0o777)
    assert environment.numba_cache().parent != shared


def test_a_command_works_without_a_writable_folder(tmp_path):
    """Instead of numba's traceback, "cannot cache function"."""
    script = "from grainmodes.kernels import compiler; print(compiler.numba.config.CACHE_DIR)"
    variables = os.environ | {"NUMBA_CACHE_DIR": NOWHERE, "TMPDIR": str(tmp_path)}
    run = subprocess.run(
        [sys.executable, "-c", script], env=variables, capture_output=True, text=True, check=True
    )
    assert run.stdout.startswith(str(tmp_path))
    assert len(run.stderr.splitlines()) == 1


def test_threads_are_pinned_where_the_user_is_silent():
    script = (
        "import os; from grainmodes.runtime.environment import prepare; prepare(); "
        "print(os.environ['NUMBA_NUM_THREADS'], os.environ['OMP_NUM_THREADS'])"
    )
    silent = {k: v for k, v in os.environ.items() if k not in environment.THREAD_VARIABLES}
    run = subprocess.run(
        [sys.executable, "-c", script],
        env=silent | {"OMP_NUM_THREADS": "4"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert run.stdout.split() == ["1", "4"]
