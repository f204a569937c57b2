"""Speeds, growth with N, and the cost of each effect."""
