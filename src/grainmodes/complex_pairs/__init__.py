"""Complex pairs of eigenvalues of M⁻¹J: found, followed from state to state, and where they meet.

| module            | holds                                                                     |
| ----------------- | ------------------------------------------------------------------------- |
| `definition`      | what a pair is; all pairs by LAPACK, the slow and certain way             |
| `carried`         | the same from the eigenvectors of the state before                        |
| `nearly_diagonal` | the eigenvalues of a nearly diagonal matrix, to which that leads          |
| `sharpening`      | pairs, and what may be some, sharpened from there                         |
| `couples`         | many planes of two eigenvectors, with their residuals                     |
| `plane`           | the plane of two eigenvectors, smooth where the two become parallel       |
| `following`       | which pair of one state is which of the next                              |
"""
