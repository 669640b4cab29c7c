"""The exact join: which counts of some wheels meet polynomial constraints, and in how many ways.

Lists of products are joined along what they share, smallest expected result first; integers and Fractions throughout.
"""
