"""The machine on which something was measured."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path


def processor_model() -> str | None:
    """Model of the processor, where Linux states it."""
    path = Path("/proc/cpuinfo")
    lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else None


def default_factorisation() -> str:
    """The factorisation that "auto" takes here."""
    return "PARDISO" if find_spec("pypardiso") else "SuperLU"
