"""Net forces and the sparse Jacobian from the forces and stiffnesses of the contacts.

Contacts are i > j sorted by (i, j). The block column of grain g therefore holds, ascending, the
partners below g in the order of their contacts, g itself, and the partners above in theirs. So the
compressed columns are written one by one, without a sort:

    J_ji = −S K,   J_gg = −Σ K − Σ S K S,   J_ij = −K S        S = diag(signs)
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.compiler import kernel


@kernel
def sum_on_grains(forces, signs, i, j, n):
    """Sum of the forces (C, k) on grains i and, with their signs (k,), on grains j; (n, k)."""
    k = signs.shape[0]
    on_i, on_j = np.zeros((n, k)), np.zeros((n, k))
    for c in range(i.shape[0]):
        for a in range(k):
            on_i[i[c], a] += forces[c, a]
            on_j[j[c], a] += forces[c, a]
    return on_i + signs * on_j


@kernel
def jacobian_columns(stiffness, signs, i, j, n):
    """(data, indices, indptr) of J in compressed columns, (kn, kn) from K (C, k, k)."""
    k = signs.shape[0]
    start = block_starts(i, j, n)
    indptr = np.empty(k * n + 1, np.int32)
    for grain in range(n):
        for b in range(k):
            indptr[k * grain + b] = k * (k * start[grain] + b * (start[grain + 1] - start[grain]))
    indptr[k * n] = k * k * start[n]
    data, indices = np.zeros(k * k * start[n]), np.empty(k * k * start[n], np.int32)
    filled, own = np.zeros(n, np.int64), np.empty(n, np.int64)
    block = np.empty((k, k))
    for c in range(i.shape[0]):
        for a in range(k):
            for b in range(k):
                block[a, b] = -signs[a] * stiffness[c, a, b]
        put_block(data, indices, indptr, j[c], i[c], filled[i[c]], block)
        filled[i[c]] += 1
    block[:] = 0.0
    for grain in range(n):
        own[grain] = filled[grain]
        put_block(data, indices, indptr, grain, grain, own[grain], block)
        filled[grain] += 1
    for c in range(i.shape[0]):
        for a in range(k):
            for b in range(k):
                block[a, b] = -stiffness[c, a, b] * signs[b]
                data[indptr[k * i[c] + b] + k * own[i[c]] + a] -= stiffness[c, a, b]
                data[indptr[k * j[c] + b] + k * own[j[c]] + a] += signs[a] * block[a, b]
        put_block(data, indices, indptr, i[c], j[c], filled[j[c]], block)
        filled[j[c]] += 1
    return data, indices, indptr


@kernel
def block_starts(i, j, n):
    """Number of blocks before the column of every grain; (n + 1,)."""
    start = np.zeros(n + 1, np.int64)
    for grain in range(n):
        start[grain + 1] = 1
    for c in range(i.shape[0]):
        start[i[c] + 1] += 1
        start[j[c] + 1] += 1
    for grain in range(n):
        start[grain + 1] += start[grain]
    return start


@kernel
def put_block(data, indices, indptr, row, column, place, block):
    """Write the block (k, k) of grains (row, column) at a place in its block column."""
    k = block.shape[0]
    for b in range(k):
        at = indptr[k * column + b] + k * place
        for a in range(k):
            data[at + a] = block[a, b]
            indices[at + a] = k * row + a
