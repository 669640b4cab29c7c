"""Sizes of triangular teeth: the radii, the clearance and the half angle that lose, err, knock or jam least."""
