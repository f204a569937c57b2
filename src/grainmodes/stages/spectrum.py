"""Spectra of a block of packings: of J, of J with the rattlers in it, of the effective Hessian.

| kind            | holds                                                              |
| --------------- | ------------------------------------------------------------------ |
| counts          | number of modes in bins of ω                                       |
| binned_averages | the same, with ψ^R and p averaged over each bin, and their errors  |
| eigenvalues     | every eigenvalue                                                   |
| modes           | every eigenvalue with ψ^R and p, and g as a sum over the modes     |

The bins depend on the point alone (`binning.fixed_edges`), so that samples can be added up. Each
row says by which method it was computed, and with which factorisation.
"""

from __future__ import annotations

from dataclasses import asdict

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.dataset.padding import stack_padded
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.hessian import effective_hessian
from grainmodes.packing.state import Packing, backbone
from grainmodes.parameters.factors import FACTORISATIONS
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.spectra import BINNED, SPECTRUM_METHODS, SpectrumChoices
from grainmodes.response.mode_sum import ModeRigidity
from grainmodes.spectrum import (
    BinnedAverages,
    Eigenproblem,
    FullSpectrum,
    average_in_bins,
    full_spectrum,
)
from grainmodes.stages.rows import response_block
from grainmodes.stages.samples import jammed_packing, springs_at_rest
from grainmodes.statistics.binning import fixed_edges


def spectrum_block(
    packings: Block,
    law: ContactLaw,
    rattlers: Rattlers,
    kind: str,
    choices: SpectrumChoices,
    processes: int = 1,
) -> Block:
    """The spectrum of every packing without its rattlers; `processes` share its slices."""
    interaction, threshold = (
        Interaction.from_law(law),
        rattlers.largest(law, springs_at_rest(packings)),
    )
    edges = fixed_edges(law.kt, choices.bin_density)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        if not jammed:
            return _unjammed_row(kind, edges, _number_of_rows(packing, law))
        eigenproblem = Eigenproblem.from_packing(packing, interaction, threshold)
        if kind in BINNED:
            averages = kind == "binned_averages"
            return _bins(average_in_bins(eigenproblem, edges, averages, choices), kind)
        if kind == "eigenvalues" or not eigenproblem.symmetric:
            found = full_spectrum(eigenproblem, kind == "modes", None, choices, processes)
            return _modes(found, _number_of_rows(packing, law), kind)
        by_mode = ModeRigidity(packing, interaction, threshold)
        found = full_spectrum(eigenproblem, True, by_mode.forces, choices, processes)
        shares = by_mode.contributions(found)
        return _modes(found, _number_of_rows(packing, law), kind) | {
            "g_mode_sum": by_mode.g_affine + float(shares.sum())
        }

    return response_block(packings, "spectrum", _config(law, rattlers, kind, choices), law, sample)


def rattlers_block(
    packings: Block, law: ContactLaw, kind: str, choices: SpectrumChoices, processes: int = 1
) -> Block:
    """The spectrum of every packing with its rattlers left in J: A, App. E."""
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        packing, _ = jammed_packing(packings, number, interaction)
        eigenproblem = Eigenproblem.from_packing(packing, interaction, keep_rattlers=True)
        found = full_spectrum(eigenproblem, kind == "modes", None, choices, processes)
        row = _modes(found, _number_of_rows(packing, law), kind)
        kept = ("eigenvalue", "psi_rotational", "participation_ratio", "mode_count")
        renamed = {f"{name}_rattlers": row[name] for name in kept if name in row}
        if found.peak_grain is not None:
            contacts = _contacts_of(packing, found.peak_grain)
            renamed["peak_contacts_rattlers"] = _padded(contacts, _number_of_rows(packing, law))
        return renamed | {"converged": True}

    config = _config(law, None, kind, choices)
    return response_block(packings, "spectrum_rattlers", config, law, sample)


def hessian_block(
    packings: Block, law: ContactLaw, rattlers: Rattlers, choices: SpectrumChoices
) -> Block:
    """Modes of the effective Hessian in bins, tangent stiffnesses and printed ones: A, (H4)."""
    interaction, threshold = (
        Interaction.from_law(law),
        rattlers.largest(law, springs_at_rest(packings)),
    )
    edges = fixed_edges(law.kt, choices.bin_density)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        row: dict[str, object] = {"bin_edge": edges, "converged": True}
        grains = backbone(packing, threshold)
        for stiffness, name in (("tangent", "hessian"), ("printed", "hessian_printed")):
            count = np.zeros(len(edges) - 1, dtype=int)
            if jammed:
                matrix = effective_hessian(grains, interaction, stiffness)
                eigenproblem = Eigenproblem(matrix, matrix.shape[0] // grains.n, symmetric=True)
                count = average_in_bins(eigenproblem, edges, False, choices).count
            row[f"bin_count_{name}"] = count
        return row

    config = _config(law, rattlers, "counts", choices)
    return response_block(packings, "spectrum_hessian", config, law, sample)


def _config(
    law: ContactLaw, rattlers: Rattlers | None, kind: str, choices: SpectrumChoices
) -> dict:
    kept = {} if rattlers is None else {"rattlers": asdict(rattlers)}
    return {"law": asdict(law), "spectrum": kind, "spectrum_choices": asdict(choices)} | kept


def _contacts_of(packing: Packing, grain: np.ndarray) -> np.ndarray:
    """Numbers of contacts of grains (M,), NaN where the number of the grain is NaN."""
    ends = np.concatenate([packing.contacts.i, packing.contacts.j])
    contacts = np.append(np.bincount(ends, minlength=packing.n), np.nan)
    return contacts[np.nan_to_num(grain, nan=packing.n).astype(int)]


def _padded(series: np.ndarray | None, columns: int) -> np.ndarray:
    """A number per mode, with NaN where there is no mode."""
    return stack_padded([series], np.nan, min_shape=(columns,))[0]


def _number_of_rows(packing: Packing, law: ContactLaw) -> int:
    """Number of rows of J with all grains: no spectrum of the packing is longer."""
    return packing.n * (3 if law.frictional else 2)


def _method_columns(method: str, factorisation: str) -> dict[str, object]:
    """By which method the row was computed, as the codes of the dataset."""
    return {
        "spectrum_method": SPECTRUM_METHODS.index(method),
        "factorisation": 0 if factorisation == "none" else FACTORISATIONS.index(factorisation),
        "converged": True,
    }


def _modes(found: FullSpectrum, columns: int, kind: str) -> dict[str, object]:
    """A row of eigenvalues, with imaginary parts only where J is not symmetric."""
    values = found.eigenvalue
    row: dict[str, object] = {
        "eigenvalue": _padded(values.real, columns),
        "mode_count": len(values),
    }
    if np.iscomplexobj(values):
        row["eigenvalue_imaginary"] = _padded(values.imag, columns)
    if kind == "modes":
        row["psi_rotational"] = _padded(found.psi_rotational, columns)
        row["participation_ratio"] = _padded(found.participation_ratio, columns)
        row["residual"] = found.residual
    return row | _method_columns(found.method, found.factorisation)


def _bins(found: BinnedAverages, kind: str) -> dict[str, object]:
    row = {
        "bin_edge": found.edge,
        "bin_count": found.count,
        "modes_below": found.below,
        "mode_count": found.modes,
    }
    if kind == "binned_averages":
        for name in ("psi_rotational", "participation_ratio"):
            row[f"bin_{name}"] = getattr(found, name)
            row[f"bin_{name}_error"] = getattr(found, f"{name}_error")
    return row | _method_columns(found.method, found.factorisation)


def _unjammed_row(kind: str, edges: np.ndarray, columns: int) -> dict[str, object]:
    """The row of an unjammed packing, which has no modes."""
    none = np.zeros(0)
    if kind not in BINNED:
        row = _modes(FullSpectrum(none, none, none, none, 0.0, method="auto"), columns, kind)
        return row | ({"g_mode_sum": 0.0} if kind == "modes" else {})
    count, nan = np.zeros(len(edges) - 1, int), np.full(len(edges) - 1, np.nan)
    no_modes = BinnedAverages(edges, count, 0, 0, nan, nan, nan, nan, method="auto")
    return _bins(no_modes, kind)
