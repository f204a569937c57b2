"""Figures of paper B.

| module               | figures    | shows                                                     |
| -------------------- | ---------- | --------------------------------------------------------- |
| `stress_strain`      | 1, 8       | stress against strain, theory and simulation              |
| `stress_brackets`    | 2          | stress against strain, events bracketed and not           |
| `stress_drop`        | 3          | smallest eigenvalue, rigidity and stress at a large drop  |
| `event_states`       | 13         | smallest eigenvalue and rigidity close to an event        |
| `event_eigenvectors` | 4          | the eigenvector of the smallest eigenvalue, as maps       |
| `event_rate`         | 5          | non-affine displacement rate after an event, as maps      |
| `event_displacement` | 6          | non-affine displacement in an event, as a map             |
| `rigidity_strain`    | 7          | rigidity and smallest eigenvalue at small strain          |
| `rigidity_mean`      | 9          | mean rigidity against strain                              |
| `tangential_error`   | 10         | normal part of the integral of tangential velocities      |
| `event_brackets`     | 11, 12     | an event in closer and closer brackets                    |
"""
