"""Ways to force balance behind one interface: each returns a `Relaxed`."""
