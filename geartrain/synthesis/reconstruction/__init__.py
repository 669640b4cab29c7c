"""Reconstruction: surviving arbors and what dials show go in, every train that explains them comes out."""
