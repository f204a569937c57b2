"""Complex pairs of eigenvalues of M⁻¹J: found, followed from state to state, and where they meet.

definition.py   what a pair is; all pairs by LAPACK, the slow and certain way
plane.py        the plane of two eigenvectors, smooth where the two themselves become parallel
following.py    which pair of one state is which of the next
"""
