"""Gears on a sphere: configurations on polyhedra and graphs, whether they turn, close, and fit."""

from geartrain.spherical.configuration import Configuration

__all__ = ["Configuration"]
