"""The exact join: which counts of some wheels meet polynomial constraints, and in how many ways.

Lists of products are joined along what they share, smallest expected result first; integers and Fractions throughout.

product_lists           the lists: distinct products with the number of ways to each, and rows of values
wheel_monomials         demands on functions of counts, and the monomials through which functions see the wheels
polynomial_constraints  demands as signs of polynomials, and windows of the last open item
join_plan               in which order items are set, by forecast cost
exact_join              the join: bucket elimination (Dechter 1999)
inside_outside          sums over all assignments of a recorded join, and the best of them (A*)
"""
