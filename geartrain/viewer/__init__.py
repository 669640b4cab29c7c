"""Interactive page of a train: one HTML file with an animated, three-dimensional view of scenes.

The page contains the data of the scenes and the program that displays them, at any number of revolutions.
"""

from __future__ import annotations

from geartrain.viewer.viewer_page import page

__all__ = ["page"]
