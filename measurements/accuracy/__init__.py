"""Work-precision diagrams: what each numerical choice costs in CPU time, and the error it leaves.

    measure.py NAME -o NAME.csv      the numbers of a diagram, with the machine and the code
    draw.py NAME.csv -o NAME         its picture

A diagram is a module of this folder with a `DIAGRAM`; `diagram.py` says what that is.
"""

NAMES = (
    "force_tolerance",
    "strain_step",
    "time_step",
    "backtracking",
    "compression_step",
    "spectrum",
    "seeds",
    "precision",
)
"""The diagrams in the order of docs/accuracy.md."""
