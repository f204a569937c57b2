"""One thread, and a cache of compiled kernels that belongs to the code under test."""

from grainmodes.runtime.environment import prepare

prepare()
