"""Speeds, growth with N, and the cost of each effect.

| command                                                  | measures                          |
| -------------------------------------------------------- | --------------------------------- |
| `python -m measurements.benchmarks.run`                  | speeds and their targets: `cases` |
| `python -m measurements.benchmarks.growth FOLDER ...`    | growth of every stage with N      |
| `python -m measurements.benchmarks.effects FILE`         | cost of each effect at each stage |
"""
