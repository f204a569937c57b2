"""Figures of our own claims: what the ensembles show and none of the papers draws.

| module               | claim | shows                                              |
| -------------------- | ----- | -------------------------------------------------- |
| `nonaffine_crossing` | G1    | G_NA against k_T, and κ*, where it changes sign    |
| `rigidity_exponent`  | G4    | G against φ − φ_J at strong friction, exponents    |

G2 is shown by `paper_a.g_nonaffine` (b), G3 by `paper_c.law_comparison`.
"""
