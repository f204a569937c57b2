"""A packing of grains and what follows from it: contacts, forces, stress, Jacobian, Hessian.

`state` holds the grains, `box` the fractions of the box, `contacts` the touching pairs and their
springs. `forces`, `jacobian`, `hessian` and `mass_weighted` are functions of a packing.
"""
