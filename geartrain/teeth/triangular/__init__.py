"""Triangular teeth of antiquity, after F. Sorge: straight flanks that meet in a point.

pair_geometry             depth, radii, centre distance, reach
tooth_couple              contact of one pair of teeth: driven angle, speed ratio, friction
real_path                 which pair of teeth drives where; collisions, dwells, clashes
clearance_window          verdict, backlash of the coast flanks, window of clearance
triangular_transmission   transmission function; a table of contact over one pitch
triangular_form           the form as declared, and its sizes
triangular_mesh           a pair of a train: figures and explanations
parameter_sweep           a pair as one or two parameters vary
"""

from geartrain.teeth.triangular.triangular_form import Triangular

__all__ = ["Triangular"]
