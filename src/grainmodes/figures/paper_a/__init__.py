"""Figures of paper A.

| module                | figure  | shows                                                  |
| --------------------- | ------- | ------------------------------------------------------ |
| `affine_fields`       | Fig. 2  | affine and non-affine displacements of a step strain   |
| `nonaffine_field`     | Fig. 3  | non-affine displacements, sum of modes and simulation  |
| `g_phi`               | Fig. 4  | G against φ                                            |
| `g_kt`                | Fig. 5  | G against k_T                                          |
| `g_nonaffine`         | Fig. 6  | G_NA against φ                                         |
| `eigenvectors`        | Fig. 7  | single eigenvectors as maps                            |
| `participation`       | Fig. 8  | ψ^T and ψ^R against ω                                  |
| `dos`                 | Fig. 9  | D(ω)                                                   |
| `dos_scaled`          | Fig. 10 | ω_R D against ω / ω_R                                  |
| `dos_frictionless`    | Fig. 11 | D(ω) with and without friction                         |
| `dos_hessian`         | Fig. 12 | D(ω) of the Jacobian and of the effective Hessian      |
| `dos_rattlers`        | Fig. 13 | D(ω) with and without rattlers                         |
| `participation_ratio` | Fig. 14 | p(ω)                                                   |
| `dos_n`               | Fig. 15 | D(ω) for several N                                     |
| `dos_phi`             | Fig. 16 | D(ω) for several φ                                     |
"""
