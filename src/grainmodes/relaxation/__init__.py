"""Ways to force balance: each returns the packing and how well it is balanced."""
