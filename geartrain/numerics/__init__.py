"""Numbers, arrays, files and independent work: nothing in this room knows what a gear is.

exact, decimal_text, factored_ratios integers and Fractions of any length, and their text
long_float, error_free               floats with an exponent of their own; sums and products with their rounding error
rounding_bounds                      a priori bounds on the rounding of sums and quotients
elimination                          sparse linear forms over the rationals
sparse_least_squares                 least squares with a few entries a row
integer_lattice, rational_angles     integer rows in a rational span; angles as parts of a turn
vectors                              three numbers as a vector in space, exact where they are
graphs                               paths in a rooted forest, groups of what is joined
block_triangular                     matching, then strongly connected components (Dulmage and Mendelsohn)
roots, simultaneous_roots            bracketed roots, one by one and many at once
chebyshev, polynomial_pieces         functions as series and as pieces of polynomials
quantity                             values with a unit, and the number as it was written
arrays, labelled_array, named_arrays arrays with names on their axes; containers that cannot change
files                                finished text and tables out, atomically
lazy_names                           names of a package that are imported when they are asked for
work                                 independent tasks, their journal, and what runs them
"""
