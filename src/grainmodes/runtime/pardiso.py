"""Whether PARDISO, an optional library, is there: `pip install 'grainmodes[pardiso]'`."""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec


@cache
def is_installed() -> bool:
    """Whether the package pypardiso is installed; whether its library loads is another question."""
    return find_spec("pypardiso") is not None


@cache
def problem() -> str:
    """Why PARDISO cannot be used, as the end of a sentence "expected …, got …"; "" if it can."""
    if not is_installed():
        return (
            "expected an installed PARDISO (pip install 'grainmodes[pardiso]', or make pardiso), "
            "got none; 'auto' and 'superlu' do without"
        )
    try:
        from pypardiso import PyPardisoSolver

        PyPardisoSolver()
    except (ImportError, OSError, RuntimeError, AttributeError) as error:
        return (
            "expected a PARDISO that loads, got an installed pypardiso whose library does not "
            f"({' '.join(str(error).split())}); repair or uninstall it, or choose 'superlu'"
        )
    return ""
