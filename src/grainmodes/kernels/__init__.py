"""Compiled inner loops: arrays and floats in, arrays and floats out, one formula per function."""
