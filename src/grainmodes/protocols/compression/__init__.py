"""Packings made by compression.

| module                 | what it does                                                         |
| ---------------------- | -------------------------------------------------------------------- |
| trajectory             | compresses random grains without friction to a packing in balance    |
| frictional_compression | compresses a packing once more with friction, which loads its springs |
"""
