"""Pairs of grains that touch or may soon touch, found with a cell list in time linear in N.

Positions are integer fractions of the box, in units of 2⁻⁶⁴ L. Subtracting two of them in 64-bit
integers wraps by itself, so the nearest image costs nothing and the difference is exact. Its
rounding does not grow with L, and so max|F| can fall below 1e-14 at every N.

    r_x = L (Δs_x + γ Δs_y),   r_y = L Δs_y          Lees–Edwards box at strain γ

| name             | shape, type    | meaning                                              |
| ---------------- | -------------- | ---------------------------------------------------- |
| first            | (N + 1,) int64 | pairs first[i] … first[i+1] − 1 have left = i         |
| left             | (P,) uint32    | grain i of a pair                                    |
| right            | (P,) uint32    | grain j of a pair, j > i                             |
| contact_distance | (P,) float64   | (d_i + d_j)/2 in d: the grains touch if r is smaller |
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.compiler import kernel

FRACTION_UNIT = 2.0**-64
"""Unit of the integer fractions, in L."""


class Neighbours(NamedTuple):
    """Pairs closer than contact_distance + skin, sorted by left."""

    first: np.ndarray
    left: np.ndarray
    right: np.ndarray
    contact_distance: np.ndarray


@kernel
def separation(x, y, i, j, scale, strain):
    """r⃗_i − r⃗_j of the nearest image, in d; scale = L · 2⁻⁶⁴; `strain` is None at γ = 0."""
    dx, dy = np.float64(x[i] - x[j]) * scale, np.float64(y[i] - y[j]) * scale
    if strain is None:
        return dx, dy
    return dx + strain * dy, dy


@kernel
def cells_per_side(box_length, cutoff, strain):
    """Number of cells along a side, so wide that a pair within `cutoff` lies in adjacent cells."""
    return max(1, int(box_length / (cutoff * (1.0 + abs(strain)))))


@kernel
def cell_index(x, y, cells):
    """Cell of every grain, (N,) int64; cells are numbered row by row."""
    index = np.empty(x.shape[0], np.int64)
    for i in range(x.shape[0]):
        column = int((np.float64(x[i]) * FRACTION_UNIT + 0.5) * cells)
        row = int((np.float64(y[i]) * FRACTION_UNIT + 0.5) * cells)
        index[i] = min(row, cells - 1) * cells + min(column, cells - 1)
    return index


@kernel
def sort_by_cell(index, cells):
    """(order, start), int64: the grains of cell c are order[start[c] : start[c + 1]]."""
    start = np.zeros(cells * cells + 1, np.int64)
    for c in index:
        start[c + 1] += 1
    for c in range(cells * cells):
        start[c + 1] += start[c]
    fill = start.copy()
    order = np.empty(index.shape[0], np.int64)
    for i in range(index.shape[0]):
        order[fill[index[i]]] = i
        fill[index[i]] += 1
    return order, start


@kernel
def adjacent_rows(row, cells, found):
    """Write the distinct rows (or columns) around `row` into `found`; return how many."""
    count = min(cells, 3)
    for k in range(count):
        around = row + k - 1
        if around < 0:
            around += cells
        elif around >= cells:
            around -= cells
        found[k] = around
    return count


@kernel
def enlarged(array, size):
    """A copy of `array` with room for `size` entries."""
    larger = np.empty(size, array.dtype)
    larger[: array.shape[0]] = array
    return larger


@kernel
def search(x, y, diameter, i, members, scale, strain, skin, right, distances, count):
    """Append the grains j > i of `members` with r < (d_i + d_j)/2 + skin; return the new count."""
    for k in range(members.shape[0]):
        j = members[k]
        contact_distance = 0.5 * (diameter[i] + diameter[j])
        dx, dy = separation(x, y, i, j, scale, strain)
        # Written always and counted only if near: a branch would be mispredicted half the time.
        right[count], distances[count] = j, contact_distance
        count += (j > i) & (dx * dx + dy * dy < (contact_distance + skin) ** 2)
    return count


@kernel
def find_neighbours(x, y, diameter, box_length, strain, skin):
    """The `Neighbours` with r < (d_i + d_j)/2 + skin: all pairs, each once.

    Args: x, y (N,) int64 in 2⁻⁶⁴ L; diameter (N,) float64 and skin in d.
    """
    n = x.shape[0]
    scale = box_length * FRACTION_UNIT
    cells = cells_per_side(box_length, diameter.max() + skin, strain)
    index = cell_index(x, y, cells)
    order, start = sort_by_cell(index, cells)
    rows, columns = np.empty(3, np.int64), np.empty(3, np.int64)
    first = np.zeros(n + 1, np.int64)
    right, distances, count = np.empty(4 * n + 16, np.uint32), np.empty(4 * n + 16), 0
    fullest = 9 * (start[1:] - start[:-1]).max()
    for i in range(n):
        if count + fullest >= right.shape[0]:
            size = 2 * right.shape[0] + fullest
            right, distances = enlarged(right, size), enlarged(distances, size)
        row_count = adjacent_rows(index[i] // cells, cells, rows)
        column_count = adjacent_rows(index[i] % cells, cells, columns)
        for row in rows[:row_count]:
            for column in columns[:column_count]:
                cell = row * cells + column
                members = order[start[cell] : start[cell + 1]]
                count = search(
                    x, y, diameter, i, members, scale, strain, skin, right, distances, count
                )
        first[i + 1] = count
    return Neighbours(first, left_of(first), right[:count].copy(), distances[:count].copy())


@kernel
def left_of(first):
    """Grain i of every pair, (P,) uint32."""
    left = np.empty(first[-1], np.uint32)
    for i in range(first.shape[0] - 1):
        left[first[i] : first[i + 1]] = i
    return left


@kernel
def touching_pairs(x, y, pairs, scale, strain):
    """The contacts among the pairs of a list, as i > j sorted by (i, j).

    Returns: i, j (C,) int32; normal (C, 2) from j to i, distance (C,), overlap (C,) in d.
    """
    n = x.shape[0]
    start = np.zeros(n + 1, np.int64)
    for pair in range(pairs.left.shape[0]):
        dx, dy = separation(x, y, pairs.right[pair], pairs.left[pair], scale, strain)
        start[pairs.right[pair] + 1] += math.sqrt(dx * dx + dy * dy) < pairs.contact_distance[pair]
    for i in range(n):
        start[i + 1] += start[i]
    size = start[n]
    i, j = np.empty(size, np.int32), np.empty(size, np.int32)
    normal, distance, overlap = np.empty((size, 2)), np.empty(size), np.empty(size)
    # The list is sorted by its left grain. Filling in by the right grain sorts by both.
    for pair in range(pairs.left.shape[0]):
        high, low = pairs.right[pair], pairs.left[pair]
        dx, dy = separation(x, y, high, low, scale, strain)
        length = math.sqrt(dx * dx + dy * dy)
        if length < pairs.contact_distance[pair]:
            c = start[high]
            start[high] += 1
            i[c], j[c], distance[c], overlap[c] = (
                high,
                low,
                length,
                pairs.contact_distance[pair] - length,
            )
            normal[c, 0], normal[c, 1] = dx / length, dy / length
    return i, j, normal, distance, overlap


@kernel
def values_of_pairs(key_i, key_j, value, i, j):
    """The value of every pair (i, j), (C,); 0 where it is not among the keys. Both are sorted."""
    found = np.zeros(i.shape[0])
    k = 0
    for c in range(i.shape[0]):
        while k < key_i.shape[0] and (key_i[k] < i[c] or (key_i[k] == i[c] and key_j[k] < j[c])):
            k += 1
        if k < key_i.shape[0] and key_i[k] == i[c] and key_j[k] == j[c]:
            found[c] = value[k]
    return found
