"""The one table of compiler flags, and the two decorators that use it.

Compression is chaotic, so the same seed gives the same packing on two machines only if each of its
numbers has the same bits on both. Therefore no flag lets the compiler reorder a sum (`reassoc`) or
round twice as one (`contract`): every operation is rounded as IEEE 754 says, in the order in which
it is written. Long sums are written in fixed lanes (`lanes`), which keeps them fast.
"""

from __future__ import annotations

import inspect
import secrets

import llvmlite.binding
import numba
from numba import njit
from numba.core.caching import FunctionCache, IndexDataCacheFile
from numba.extending import overload, register_jitable

from grainmodes.runtime.environment import numba_cache

FLAGS = {"cache": True, "error_model": "numpy", "nogil": True}

# numba's cache does not see an edit in a called function of another file, so its folder is named by
# the fingerprint of the kernels, also where the package is used as a library.
numba.config.CACHE_DIR = str(numba_cache())

# Loops over many arrays need more overlap checks than LLVM's default allows before it vectorises.
llvmlite.binding.set_option("", "--runtime-memory-check-threshold=128")

LAWS: dict[object, set[type]] = {}
"""Generic function → the laws that implement it."""

OUTSIDE: set[type] = set()
"""Laws that a function from outside the package stands behind."""


class _CacheFile(IndexDataCacheFile):
    """Files of compiled code that several processes may write at once.

    numba numbers a data file after the index that it has just read. Two processes that compile one
    kernel for two laws at the same time take the same number, and then one law can run with the
    code of the other. With random numbers the worst that happens is that a law is compiled twice.
    """

    def _data_name(self, number):
        return super()._data_name(secrets.randbits(63))


class _Cache(FunctionCache):
    """numba's cache on disk, closed to laws from outside: it would not see an edit of them."""

    def __init__(self, function):
        super().__init__(function)
        self._cache_file = _CacheFile(
            cache_path=self._cache_path,
            filename_base=self._impl.filename_base,
            source_stamp=self._impl.locator.get_source_stamp(),
        )

    def load_overload(self, sig, target_context):
        return None if _from_outside(sig) else super().load_overload(sig, target_context)

    def save_overload(self, sig, data):
        if not _from_outside(sig):
            super().save_overload(sig, data)


def _from_outside(types) -> bool:
    """Whether a law from outside is among these types of arguments, or within one of them."""
    return any(
        getattr(one, "instance_class", None) in OUTSIDE or _from_outside(getattr(one, "types", ()))
        for one in types
    )


def kernel(function):
    """The function compiled for every set of types that it meets, and kept on disk."""
    compiled = njit(**FLAGS)(function)
    compiled._cache = _Cache(function)
    return compiled


def implements(generic, law_type):
    """Register a function as `generic` for laws of `law_type`; numba picks it by argument type.

    The first argument of the function is the law, an instance of the NamedTuple `law_type`. A law
    from outside the package joins in the same way; what is compiled for it is not kept on disk.
    """

    def register(function):
        LAWS.setdefault(generic, set()).add(law_type)
        if not function.__module__.startswith(f"{__package__.partition('.')[0]}."):
            OUTSIDE.add(law_type)
        return _overload(generic, function, lambda law: law is law_type)

    return register


def otherwise(generic):
    """Register a function as `generic` for all laws that do not implement it themselves."""
    return lambda function: _overload(generic, function, lambda law: law not in LAWS[generic])


def _overload(generic, function, takes):
    """Let numba take the function for `generic` where `takes` says so of the type of the law."""
    body = register_jitable(function)
    names = list(inspect.signature(function).parameters)

    def choose(*types):
        return body if takes(getattr(types[0], "instance_class", None)) else None

    signature = ", ".join(names)
    scope = {"choose": choose}
    exec(f"def specialise({signature}): return choose({signature})", scope)
    overload(generic, jit_options={"error_model": "numpy"})(scope["specialise"])
    return function
