"""Work-precision diagrams: what each numerical choice costs in CPU time, and the error it leaves.

    python -m measurements.accuracy.measure NAME -o NAME.csv   the numbers of a diagram
    python -m measurements.accuracy.draw NAME.csv -o NAME      its picture

| diagram            | numerical choice                                              |
| ------------------ | ------------------------------------------------------------- |
| `force_tolerance`  | F_Th of a force balance                                       |
| `strain_step`      | Δγ of a simulated step strain                                 |
| `time_step`        | Δt of the dynamics                                            |
| `backtracking`     | Δγ_Th, how closely an event is bracketed                      |
| `compression_step` | step of φ in a compression, and how far each step is relaxed  |
| `frictional_compression` | steps of φ, balance, Δt, cut-off and drag where friction acts |
| `spectrum`         | method for eigenvalues, D(ω) and ψ^R                          |
| `seeds`            | number of seeds of an ensemble                                |
| `precision`        | single or double precision                                    |

Each is a module with a `DIAGRAM`; `diagram` defines what that is, `table` is its file. The other
modules are what these measurements need.
"""

NAMES = (
    "force_tolerance",
    "strain_step",
    "time_step",
    "backtracking",
    "compression_step",
    "frictional_compression",
    "spectrum",
    "seeds",
    "precision",
)
"""The diagrams in the order of docs/accuracy.md."""
