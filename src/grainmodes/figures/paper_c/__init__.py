"""Figures of paper C.

| module             | figures | shows                                                           |
| ------------------ | ------- | --------------------------------------------------------------- |
| `pair_birth`       | 1       | two real eigenvalues become a complex pair                      |
| `pair_overlap`     | 2, 3    | scalar products of eigenvectors around a complex pair           |
| `pair_exponent`    | 4       | difference of two eigenvalues against the distance to γ_c       |
| `release_spirals`  | 5       | trajectories of the grains while a released pair grows          |
| `film`             | 5       | the same as a film                                              |
| `release_growth`   | 6       | growth of M(t) and A(t)                                         |
| `release_outcome`  | 7       | M, pressure and shear stress over all times                     |
| `release_spectrum` | 8       | complex pairs along a release                                   |
| `release_contacts` | 9       | contacts along a release                                        |
| `release_pressure` | 10      | pressures of contacts and grains before and after a release     |
| `release_damping`  | 11      | the same state released under several dampings                  |
| `release_pair`     | 12      | the pair along its shear, and its growth when it is released    |
| `release_times`    |         | when the growth of released states ends, against their ω_i      |
| `law_comparison`   | 12(a)   | complex pairs under several tangential laws, and their growth   |
"""
