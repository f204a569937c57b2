"""Compression and strain: how a packing is led from one balance to the next."""
