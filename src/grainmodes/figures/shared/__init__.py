"""What several figures share.

| module             | holds                                                                  |
| ------------------ | ---------------------------------------------------------------------- |
| `selection`        | the options of a study; which values of the grid a figure shows        |
| `columns`          | columns of the CSV files that recur                                    |
| `appearance`       | colours, symbols, legend entries                                       |
| `missing`          | samples that a figure lacks, and why                                   |
| `labels`           | numbers as formulas, units of axes, titles, lines above pictures       |
| `captions`         | the text beside every picture                                          |
| `rigidity_rows`    | mean G at the points of a grid: A, Figs. 4 to 6                        |
| `spectral_points`  | which points of a grid have spectra to show                            |
| `spectral_rows`    | D, ψ and p in bins of ω: A, Figs. 8 to 16                              |
| `spectral_panels`  | their panels                                                           |
| `mode_marks`       | the marks (a1), …, (b3) that tie A, Figs. 8 and 9 to Fig. 7            |
| `sheared_samples`  | curves of sheared samples: B, Figs. 1, 2, 7 to 9                       |
| `pair_samples`     | samples with exceptional points: C, Figs. 1 to 4                       |
| `sample_files`     | files of single samples, and which of them a figure shows              |
| `grain_rows`       | a row per grain                                                        |
| `grain_maps`       | maps of grains with arrows and colours                                 |
| `map_scale`        | how a map translates a field into arrows and colours                   |
| `step_strain_maps` | two displacement fields side by side: A, Figs. 2 and 3; B, Fig. 5      |
| `event_rows`       | states around one event: B, Figs. 3, 10 to 13                          |
| `event_maps`       | fields of one event: B, Figs. 4 to 6                                   |
| `release_rows`     | runs of released samples: C, Figs. 5 to 11                             |
"""
