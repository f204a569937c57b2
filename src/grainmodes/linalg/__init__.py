"""Linear algebra with sparse matrices: factors, inertia, solutions, eigenpairs near a shift.

Nothing here knows of grains: the matrices come from elsewhere.
"""
