"""What a sample is made of: the point of the grid, the contact law, the protocols.

Frozen dataclasses of plain numbers, and the one formatter that turns a value into the text that
stands in a path and back. Standard library only, so that the Snakefile can import it cheaply.

Units everywhere: k_N = m = d = 1, with d the diameter of the large grains and m their mass (C: of
the small grains, `Compression.large_diameter` = 1.4, and of every grain);
forces in k_N d^(3/2) (Hertz) or k_N d (harmonic), time in t_0.
"""
