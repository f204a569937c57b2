"""Complex pairs of eigenvalues of M⁻¹J: found, matched from state to state, and where they meet.

| module                | holds                                                                 |
| --------------------- | --------------------------------------------------------------------- |
| `definition`          | what a complex pair is; all pairs by LAPACK, the slow and certain way |
| `continuation`        | all pairs from the eigenbasis of the state before                     |
| `partitioning`        | all eigenpairs of a nearly diagonal matrix, to second order           |
| `refinement`          | complex pairs and near-degenerate eigenvalues refined                 |
| `invariant_subspaces` | many two-dimensional subspaces with their residuals                   |
| `inverse_iteration`   | one subspace, smooth where its two eigenvectors become parallel       |
| `disc_sweep`          | all pairs of one large K by shift-invert Arnoldi, disc after disc     |
| `arnoldi_discs`       | all eigenvalues in one disc                                           |
| `matching`            | which pair of one state is which pair of the next                     |
| `damped_growth`       | growth rate and threshold of a pair under a drag                      |
"""
