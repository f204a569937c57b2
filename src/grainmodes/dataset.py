"""Blocks of samples on disk: one netCDF file per (point, block of seeds), and what its names mean.

A block is a dictionary of arrays. `VARIABLES` is the one table of names: dimensions, units,
long name. Writing is atomic (temporary name, then rename) and the bytes depend on nothing but
the content, so that a resumed study ends with the same files as an unbroken one.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import netCDF4
import numpy as np

from grainmodes.atomic import replaced


class Variable(NamedTuple):
    """One row of the table of names."""

    dimensions: tuple[str, ...]
    dtype: str
    units: str
    long_name: str


BLOCK = ("seed",)
MODES = ("seed", "mode")
BINS = ("seed", "bin")
FORCE = "k_N d^(3/2)"
MODULUS = "k_N d^(1/2)"

VARIABLES: dict[str, Variable] = {
    # coordinates
    "seed": Variable(("seed",), "i8", "1", "seed of the random placement"),
    "n": Variable(("n",), "i8", "1", "number of grains"),
    "phi": Variable(("phi",), "f8", "1", "projected area fraction"),
    "kt": Variable(("kt",), "f8", "k_N", "tangential stiffness k_T / k_N"),
    "mode": Variable(("mode",), "i8", "1", "rank of a mode, eigenvalues ascending"),
    # packing
    "position": Variable(("seed", "grain", "axis"), "f8", "d", "grain position in [0, L), (x, y)"),
    "fraction": Variable(
        ("seed", "grain", "axis"),
        "i8",
        "2^-64 L",
        "grain position as an integer fraction of the box: the exact state",
    ),
    "diameter": Variable(("seed", "grain"), "f8", "d", "grain diameter"),
    "mass": Variable(("seed", "grain"), "f8", "m", "grain mass"),
    "box_length": Variable(BLOCK, "f8", "d", "side L of the periodic square box"),
    "strain": Variable(BLOCK, "f8", "1", "shear strain of the Lees-Edwards box"),
    "contact_i": Variable(("seed", "contact"), "i4", "1", "grain i of a contact, i > j; -1: none"),
    "contact_j": Variable(("seed", "contact"), "i4", "1", "grain j of a contact; -1: none"),
    "tangential_displacement": Variable(
        ("seed", "contact"), "f8", "d", "signed tangential displacement s of a contact"
    ),
    "pressure": Variable(BLOCK, "f8", MODULUS, "pressure (sigma_xx + sigma_yy) / -2"),
    "contact_number": Variable(
        BLOCK, "f8", "1", "mean number of contacts of a grain that is no rattler"
    ),
    "rattler_count": Variable(BLOCK, "i8", "1", "number of rattlers"),
    "phi_jamming": Variable(
        BLOCK, "f8", "1", "highest phi of the trajectory so far at which it was not jammed"
    ),
    # how a sample came out
    "converged": Variable(BLOCK, "i1", "1", "1 if the requested accuracy was reached, else 0"),
    "jammed": Variable(BLOCK, "i1", "1", "1 if a rigid backbone carries the load, else 0"),
    "max_force": Variable(BLOCK, "f8", FORCE, "largest force component left on a grain"),
    "max_torque": Variable(BLOCK, "f8", FORCE, "largest scaled torque 2 T / d left on a grain"),
    "iterations": Variable(BLOCK, "i8", "1", "iterations of the relaxation"),
    "step": Variable(BLOCK, "i8", "1", "number of the grid step on which a trajectory stands"),
    # rigidity, theory
    "g": Variable(BLOCK, "f8", MODULUS, "rigidity under an unloaded step strain"),
    "g_affine": Variable(BLOCK, "f8", MODULUS, "affine part of g"),
    "g_nonaffine": Variable(BLOCK, "f8", MODULUS, "non-affine part of g"),
    "g_loaded": Variable(BLOCK, "f8", MODULUS, "rigidity, tangential springs loaded affinely"),
    "g_affine_loaded": Variable(BLOCK, "f8", MODULUS, "affine part of g_loaded"),
    "g_nonaffine_loaded": Variable(BLOCK, "f8", MODULUS, "non-affine part of g_loaded"),
    # rigidity, simulation
    "g_simulated": Variable(
        BLOCK, "f8", MODULUS, "rigidity from step strains to both sides, relaxed"
    ),
    "g_simulated_forward": Variable(
        BLOCK, "f8", MODULUS, "rigidity from the forward step strain alone (paper A)"
    ),
    "g_simulated_error": Variable(
        BLOCK, "f8", MODULUS, "difference of g_simulated to that of a step ten times larger"
    ),
    "strain_simulated": Variable(BLOCK, "f8", "1", "size of the step strain of g_simulated"),
    "iterations_simulated": Variable(
        BLOCK, "i8", "1", "iterations of the relaxation of the step strains"
    ),
    "max_force_simulated": Variable(
        BLOCK, "f8", FORCE, "largest force component left after the step strains"
    ),
    "max_torque_simulated": Variable(
        BLOCK, "f8", FORCE, "largest scaled torque 2 T / d left after the step strains"
    ),
    "contact_changes": Variable(
        BLOCK, "i8", "1", "contacts opened or closed by the relaxed step strain"
    ),
    # spectrum
    "eigenvalue": Variable(
        ("seed", "mode"), "f8", "k_N d^(1/2)", "eigenvalue of the Jacobian, ascending; NaN: no mode"
    ),
    "eigenvalue_imaginary": Variable(
        ("seed", "mode"), "f8", "k_N d^(1/2)", "imaginary part, where the Jacobian is not symmetric"
    ),
    "psi_rotational": Variable(("seed", "mode"), "f8", "1", "rotational fraction psi^R of a mode"),
    "participation_ratio": Variable(("seed", "mode"), "f8", "1", "participation ratio p of a mode"),
    "eigenvalue_rattlers": Variable(
        ("seed", "mode"), "f8", MODULUS, "eigenvalue of the Jacobian with the rattlers in it"
    ),
    "psi_rotational_rattlers": Variable(
        ("seed", "mode"), "f8", "1", "psi^R of a mode of the Jacobian with the rattlers in it"
    ),
    "participation_ratio_rattlers": Variable(
        ("seed", "mode"), "f8", "1", "p of a mode of the Jacobian with the rattlers in it"
    ),
    "mode_count_rattlers": Variable(BLOCK, "i8", "1", "number of modes with the rattlers in"),
    "residual": Variable(BLOCK, "f8", "k_N d^(1/2)", "largest eigenpair residual |J v - lambda v|"),
    "g_mode_sum": Variable(BLOCK, "f8", MODULUS, "g as a sum over the modes"),
    "spectrum_method": Variable(
        BLOCK,
        "i1",
        "1",
        "how the spectrum was computed: 0 no modes, 1 dense, 2 windows, 3 counting",
    ),
    "factorisation": Variable(
        BLOCK, "i1", "1", "sparse factorisation of the spectrum: 0 none, 1 superlu, 2 pardiso"
    ),
    # spectrum in bins
    "bin_edge": Variable(("seed", "edge"), "f8", "1/t_0", "edge of a bin of frequency"),
    "bin_count": Variable(("seed", "bin"), "i8", "1", "number of modes in a bin"),
    "modes_below": Variable(
        BLOCK, "i8", "1", "number of modes below the first bin, zero modes too"
    ),
    "bin_psi_rotational": Variable(("seed", "bin"), "f8", "1", "mean psi^R in a bin"),
    "bin_psi_rotational_error": Variable(
        ("seed", "bin"), "f8", "1", "standard error of the mean psi^R in a bin"
    ),
    "bin_participation_ratio": Variable(("seed", "bin"), "f8", "1", "mean p in a bin"),
    "bin_participation_ratio_error": Variable(
        ("seed", "bin"), "f8", "1", "standard error of the mean p in a bin"
    ),
    "bin_count_hessian": Variable(
        ("seed", "bin"), "i8", "1", "modes of the effective Hessian, tangent stiffnesses, in a bin"
    ),
    "bin_count_hessian_printed": Variable(
        ("seed", "bin"), "i8", "1", "modes of the effective Hessian as printed in (H2), in a bin"
    ),
    "mode_count": Variable(BLOCK, "i8", "1", "number of modes: degrees of freedom of the backbone"),
    # probes of single claims
    "probe_strain": Variable(("seed", "probe"), "f8", "1", "step strains of g_forward_by_strain"),
    "g_forward_by_strain": Variable(
        ("seed", "probe"), "f8", MODULUS, "rigidity from one forward step strain of each size"
    ),
    "g_translational": Variable(
        BLOCK, "f8", MODULUS, "g as a sum over the modes with psi^R < 1/2 alone"
    ),
    "hessian_difference": Variable(
        BLOCK,
        "f8",
        "1",
        "max |H - J| / max |J| of the effective Hessian H, tangent stiffnesses",
    ),
    "hessian_printed_difference": Variable(
        BLOCK, "f8", "1", "the same with the constants k_N and k_T"
    ),
    "verlet_order_position": Variable(
        BLOCK, "f8", "1", "order up to which a step of velocity Verlet is right in q"
    ),
    "verlet_order_velocity": Variable(
        BLOCK, "f8", "1", "order up to which a step of velocity Verlet is right in dq/dt"
    ),
    "complex_pairs_frictional": Variable(
        BLOCK, "f8", "1", "complex pairs of eigenvalues of J / M after compression with friction"
    ),
    "jammed_frictional": Variable(
        BLOCK, "f8", "1", "1 if the state compressed with friction is jammed, else 0"
    ),
    # fields, (x, y, l) of every grain; NaN: a rattler
    "affine_field": Variable(
        ("seed", "grain", "component"), "f8", "d", "affine displacement per unit strain, (x, y, l)"
    ),
    "nonaffine_field": Variable(
        ("seed", "grain", "component"), "f8", "d", "non-affine displacement per unit strain"
    ),
    "nonaffine_field_mode_sum": Variable(
        ("seed", "grain", "component"), "f8", "d", "nonaffine_field as a sum over the modes"
    ),
    "nonaffine_field_simulated": Variable(
        ("seed", "grain", "component"), "f8", "d", "nonaffine_field from relaxed step strains"
    ),
    "frequency_asked": Variable(
        ("seed", "frequency"), "f8", "1/t_0", "frequency near which an eigenvector is sought"
    ),
    "frequency_found": Variable(
        ("seed", "frequency"), "f8", "1/t_0", "frequency of the mode nearest to frequency_asked"
    ),
    "eigenvector": Variable(
        ("seed", "frequency", "grain", "component"), "f8", "1", "its eigenvector, of norm 1"
    ),
}
"""Every name that a block or an ensemble may hold."""


class BlockError(Exception):
    """A file that is not a readable block; the message says which file and why."""


@dataclass(frozen=True)
class Block:
    """Arrays by name, and the attributes that say where they come from."""

    variables: dict[str, np.ndarray]
    attributes: dict[str, object]


def write_block(path: str | Path, block: Block) -> None:
    """Write a block: all of it or nothing.

    `block.variables` maps names of `VARIABLES` to arrays with those dimensions. Attribute values
    are numbers, text, or dictionaries (stored as sorted JSON).

    Raises:
        KeyError: a name is not in `VARIABLES`.
        ValueError: two arrays disagree about the length of a dimension.
        OSError: the file cannot be written; nothing is left under `path`.
    """
    with new_file(path) as file:
        _write(file, block)


@contextmanager
def new_file(path: str | Path) -> Iterator[netCDF4.Dataset]:
    """A netCDF file to write into, which stands under `path` only once it is whole.

    Raises:
        OSError: the file cannot be written; whatever stood under `path` is untouched.
    """
    try:
        with replaced(path) as partial, netCDF4.Dataset(partial, "w", format="NETCDF4") as file:
            yield file
    except RuntimeError as error:
        raise OSError(f"{path}: cannot be written; is the disk full? ({error})") from error


def _write(file: netCDF4.Dataset, block: Block) -> None:
    for name, value in sorted(block.attributes.items()):
        file.setncattr(
            name, json.dumps(value, sort_keys=True) if isinstance(value, dict) else value
        )
    for name, array in block.variables.items():
        row = VARIABLES[name]
        array = np.asarray(array, dtype=row.dtype)
        for dimension, length in zip(row.dimensions, array.shape, strict=True):
            if dimension not in file.dimensions:
                file.createDimension(dimension, length)
            elif len(file.dimensions[dimension]) != length:
                raise ValueError(
                    f"{name}: dimension {dimension} has length {length}, "
                    f"elsewhere {len(file.dimensions[dimension])}"
                )
        compressed = {"zlib": True, "complevel": 1, "shuffle": True} if array.ndim > 1 else {}
        variable = file.createVariable(name, row.dtype, row.dimensions, **compressed)
        variable.units = row.units
        variable.long_name = row.long_name
        variable[...] = array


def read_block(path: str | Path) -> Block:
    """Read a block whole.

    Raises:
        BlockError: no such file, not netCDF, truncated, or without the `seed` dimension.
    """
    path = Path(path)
    if not path.is_file():
        raise BlockError(f"{path}: no such file")
    try:
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            variables = {name: variable[...] for name, variable in file.variables.items()}
            attributes = {name: file.getncattr(name) for name in file.ncattrs()}
    except (OSError, RuntimeError) as error:
        raise BlockError(
            f"{path}: not a readable netCDF file, or a truncated one ({error})"
        ) from error
    unknown = sorted(set(variables) - set(VARIABLES))
    if unknown:
        raise BlockError(f"{path}: unknown variable {', '.join(unknown)}, see docs/data.md")
    if "seed" not in variables:
        raise BlockError(f"{path}: holds no variable 'seed', so it is not a block of samples")
    return Block(variables, attributes)
