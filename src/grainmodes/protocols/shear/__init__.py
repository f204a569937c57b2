"""Athermal quasistatic shear, and what is measured along it.

| module            | what it holds                                                          |
| ----------------- | ---------------------------------------------------------------------- |
| strain_step       | one step of the strain, relaxed to its equilibrium                     |
| sheared_state     | an equilibrium along a shear: stress, rigidity, lowest eigenvalue      |
| events            | changes of the contact network and plastic events between two states   |
| quasistatic_run   | a whole shear, whose events are bracketed                              |
| first_event       | the first event of a shear in ever narrower brackets                   |
| event_states      | the states on both branches around an event, and the motion there      |
| event_multipoles  | how the rotations of an event are arranged around its centre           |
| tangential_path   | whether the integral of tangential velocities is tangential            |
| coulomb_threshold | J and its complex pairs on both sides of Coulomb's threshold           |
| step_strain       | the rigidity of a simulated step strain                                |
| step_strain_field | the displacement field of a simulated step strain                      |
"""
