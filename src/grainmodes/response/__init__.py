"""Linear response of a packing in force balance: moduli, sums over modes, fields, stability."""
