"""Dynamics of unstable states: C, Sec. VI and VIII.

| module           | what it holds                                                            |
| ---------------- | ------------------------------------------------------------------------ |
| unstable_state   | a balance with a complex pair, and what linear theory says of its growth |
| followed_pair    | the released pair along its own dynamics: when it dies                   |
| release_run      | the dynamics from there, with records, a film and spectra on the way     |
| record           | the numbers recorded of a moving state, and the stress of every grain    |
| growth_fit       | the growth rate and the frequency, fitted to the records                 |
| outcome          | the stages that a release goes through, from its records                 |
| spirals          | the spirals that the grains draw while the mode grows                    |
| simulated_growth | the growth rate of a pair in a short simulation along its mode           |
"""
