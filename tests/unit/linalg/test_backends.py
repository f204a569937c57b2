"""Which factorisation is taken, and how a missing, broken or exhausted one is told."""

import json
import sys

import numpy as np
import pytest
import scipy.sparse as sparse

from example_packings import BACKENDS
from grainmodes.cli import main
from grainmodes.configuration import ConfigurationError, scene_from, stage_settings
from grainmodes.linalg import backends, superlu
from grainmodes.linalg.factorisation import ZeroPivotError
from grainmodes.linalg.failures import FactorisationError
from grainmodes.linalg.pinned_factor import FloppyError, PinnedFactor
from grainmodes.runtime import pardiso

NAMED = {"protocol": {"spectrum": {"factorisation": "pardiso"}}}

BROKEN = """
class PyPardisoSolver:
    def __init__(self, *arguments, **keywords):
        raise {error}("libmkl_rt.so.2: cannot open shared object file")
"""


def forget() -> None:
    """Look for PARDISO again."""
    pardiso.problem.cache_clear()
    pardiso.is_installed.cache_clear()


@pytest.fixture
def absent(monkeypatch):
    """PARDISO is not installed."""
    forget()
    monkeypatch.setitem(sys.modules, "pypardiso", None)
    monkeypatch.setattr(pardiso, "find_spec", lambda name: None)
    yield
    forget()


@pytest.fixture(params=["ImportError", "OSError"])
def broken(request, monkeypatch, tmp_path):
    """PARDISO is installed, and its library does not load."""
    (tmp_path / "pypardiso.py").write_text(BROKEN.format(error=request.param), encoding="utf-8")
    for name in [name for name in sys.modules if name.partition(".")[0] == "pypardiso"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.syspath_prepend(str(tmp_path))
    forget()
    yield
    forget()
    sys.modules.pop("pypardiso", None)


def scene(n: int) -> dict:
    """A scene that names PARDISO."""
    grid = {"n": [n], "phi": [0.9], "kt": [1e-4], "seeds": 2, "observables": {"spectrum": "counts"}}
    return {"study": "absent", "grids": [grid]} | NAMED


@pytest.mark.parametrize("n", [64, 1024])
def test_a_scene_that_names_an_absent_pardiso_is_refused(absent, n):
    with pytest.raises(ConfigurationError, match=r"expected an installed PARDISO .* got none"):
        scene_from(scene(n))


@pytest.mark.parametrize("n", [64, 1024])
def test_a_scene_that_names_a_broken_pardiso_is_refused(broken, n):
    sentence = r"expected a PARDISO that loads, got .* does not .libmkl_rt.so.2: cannot open"
    with pytest.raises(ConfigurationError, match=sentence):
        scene_from(scene(n))


def test_a_command_that_names_it_says_so_before_it_reads(absent, capsys, tmp_path):
    words = ["spectrum", "none.nc", "--kt", "1", "--settings", json.dumps(NAMED)]
    assert main([*words, "-o", str(tmp_path / "s.nc")]) == 1
    assert capsys.readouterr().err.count("\n") == 1
    with pytest.raises(ConfigurationError, match="PARDISO"):
        stage_settings(NAMED)


def test_without_it_auto_takes_superlu(absent):
    assert backends.choose_backend("auto", 10**6) == "superlu"


def test_auto_never_takes_the_other_one_where_it_does_not_load(broken):
    small, large = (sparse.csc_array(sparse.eye_array(size)) for size in (10, 3000))
    assert backends.make_factorisation(small).name == "superlu"
    with pytest.raises(FactorisationError, match=r"does not .libmkl_rt.so.2: cannot open"):
        backends.make_factorisation(large)
    with pytest.raises(FactorisationError, match="PARDISO"):
        backends.make_factorisation(small, "pardiso")


@pytest.mark.skipif("pardiso" not in BACKENDS, reason="needs pypardiso")
@pytest.mark.parametrize(
    ("code", "kind"),
    [(-2, MemoryError), (-9, MemoryError), (-4, ZeroPivotError), (-1, FactorisationError)],
)
def test_errors_of_pardiso_by_type(code, kind, monkeypatch):
    from pypardiso.pardiso_wrapper import PyPardisoError

    def fail(*arguments):
        raise PyPardisoError(code)

    factors = backends.make_factorisation(sparse.csc_array(np.eye(3)), "pardiso")
    with monkeypatch.context() as patch:
        patch.setattr(factors._solver, "_call_pardiso", fail)
        with pytest.raises(kind, match=f"error code {code}"):
            factors.refactor(np.ones(3))


@pytest.mark.parametrize(
    ("error", "kind"),
    [
        (RuntimeError("Factor is exactly singular"), ZeroPivotError),
        (RuntimeError("SUPERLU_MALLOC fails for buf in intMalloc()"), MemoryError),
        (MemoryError(), MemoryError),
    ],
)
def test_superlu_without_memory_is_not_a_singular_matrix(error, kind, monkeypatch):
    def fail(*arguments, **options):
        raise error

    monkeypatch.setattr(superlu, "splu", fail)
    pattern = sparse.csc_array(np.eye(8))
    with pytest.raises(kind):
        superlu.SuperLU(pattern).refactor(np.ones(8))
    for symmetric in (True, False):
        with pytest.raises(FloppyError if kind is ZeroPivotError else MemoryError):
            PinnedFactor(pattern, symmetric, "superlu")
