"""Packings made by compression.

| module                | what it does                                                            |
| --------------------- | ----------------------------------------------------------------------- |
| trajectory            | compresses random grains without friction to a packing in balance (A)   |
| frictional_trajectory | compresses random grains with friction, which loads their springs (B)   |
"""
