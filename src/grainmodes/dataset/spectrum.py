"""Names of spectra: mode by mode, and in bins of frequency."""

from __future__ import annotations

from grainmodes.dataset.units import MODULUS, NUMBER, RATE
from grainmodes.dataset.variable import BINS, BLOCK, MODES, Variable

NAMES = {
    # spectrum
    "eigenvalue": Variable(
        MODES, "f8", MODULUS, "eigenvalues of the Jacobian in ascending order; NaN: no mode"
    ),
    "eigenvalue_imaginary": Variable(
        MODES,
        "f8",
        MODULUS,
        "imaginary parts of the eigenvalues, where the Jacobian is not symmetric",
    ),
    "psi_rotational": Variable(MODES, "f8", NUMBER, "rotational fraction psi^R of a mode"),
    "participation_ratio": Variable(MODES, "f8", NUMBER, "participation ratio p of a mode"),
    "eigenvalue_rattlers": Variable(
        MODES, "f8", MODULUS, "eigenvalues of the Jacobian that includes the rattlers"
    ),
    "psi_rotational_rattlers": Variable(
        MODES,
        "f8",
        NUMBER,
        "rotational fraction psi^R of a mode of the Jacobian that includes the rattlers",
    ),
    "participation_ratio_rattlers": Variable(
        MODES,
        "f8",
        NUMBER,
        "participation ratio p of a mode of the Jacobian that includes the rattlers",
    ),
    "peak_contacts_rattlers": Variable(
        MODES,
        "f8",
        NUMBER,
        "number of contacts of the grain that moves most in a mode of the Jacobian that includes "
        "the rattlers",
    ),
    "mode_count_rattlers": Variable(
        BLOCK, "i8", NUMBER, "number of modes of the Jacobian that includes the rattlers"
    ),
    "residual": Variable(
        BLOCK, "f8", MODULUS, "largest residual |J v - lambda v| of the eigenpairs"
    ),
    "g_mode_sum": Variable(BLOCK, "f8", MODULUS, "g as a sum over the modes"),
    "spectrum_method": Variable(
        BLOCK,
        "i1",
        NUMBER,
        "method of the spectrum; 0: no modes, 1: dense, 2: spectrum slicing, 3: inertia counts",
    ),
    "factorisation": Variable(
        BLOCK, "i1", NUMBER, "sparse factorisation of the spectrum; 0: none, 1: superlu, 2: pardiso"
    ),
    # spectrum in bins
    "bin_edge": Variable(("seed", "edge"), "f8", RATE, "edge of a bin of frequency"),
    "bin_count": Variable(BINS, "i8", NUMBER, "number of modes in a bin"),
    "modes_below": Variable(
        BLOCK, "i8", NUMBER, "number of modes below the first bin, including zero modes"
    ),
    "bin_psi_rotational": Variable(BINS, "f8", NUMBER, "mean psi^R of the modes in a bin"),
    "bin_psi_rotational_error": Variable(
        BINS, "f8", NUMBER, "standard error of the mean psi^R in a bin"
    ),
    "bin_participation_ratio": Variable(BINS, "f8", NUMBER, "mean p of the modes in a bin"),
    "bin_participation_ratio_error": Variable(
        BINS, "f8", NUMBER, "standard error of the mean p in a bin"
    ),
    "bin_count_hessian": Variable(
        BINS,
        "i8",
        NUMBER,
        "number of modes of the effective Hessian with tangent stiffnesses in a bin",
    ),
    "bin_count_hessian_printed": Variable(
        BINS, "i8", NUMBER, "number of modes of the effective Hessian as printed in (H2) in a bin"
    ),
    "mode_count": Variable(
        BLOCK, "i8", NUMBER, "number of modes: the degrees of freedom of the backbone"
    ),
}
