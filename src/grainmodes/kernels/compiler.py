"""The one table of compiler flags, and the two decorators that use it.

`reassoc` lets sums over grains and contacts vectorise; the order of a sum is then fixed by the
machine, so the same machine gives the same bytes. NaN and infinity keep their meaning.
"""

from __future__ import annotations

import inspect

import llvmlite.binding
import numba
from numba import njit
from numba.extending import overload, register_jitable

from grainmodes.environment import numba_cache

FLAGS = {
    "cache": True,
    "error_model": "numpy",
    "nogil": True,
    "fastmath": {"reassoc", "contract", "nsz"},
}

# numba's cache does not see an edit in a called function of another file, so its folder is named by
# the fingerprint of the kernels, also where the package is used as a library.
numba.config.CACHE_DIR = str(numba_cache())

# Loops over many arrays need more overlap checks than LLVM's default allows before it vectorises.
llvmlite.binding.set_option("", "--runtime-memory-check-threshold=128")

kernel = njit(**FLAGS)


def implements(generic, law_type):
    """Register a function as `generic` for laws of `law_type`; numba picks it by argument type.

    The first argument of the function is the law, an instance of the NamedTuple `law_type`. A law
    from outside the package joins in the same way.
    """

    def register(function):
        body = register_jitable(function)
        names = list(inspect.signature(function).parameters)

        def choose(*types):
            matches = getattr(types[0], "instance_class", None) is law_type
            return body if matches else None

        signature = ", ".join(names)
        scope = {"choose": choose}
        exec(f"def specialise({signature}): return choose({signature})", scope)
        overload(generic, jit_options={"fastmath": FLAGS["fastmath"], "error_model": "numpy"})(
            scope["specialise"]
        )
        return function

    return register
