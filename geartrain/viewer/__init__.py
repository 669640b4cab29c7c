"""Interactive page of a train: one HTML file with an animated, three-dimensional view.

The input is one or more scenes of `geartrain.scene`. The output is a self-contained page with the data of the scenes
and the program that displays the scenes; the program computes angles exactly at any number of revolutions. Buttons of
the page save pictures and films.
"""

from __future__ import annotations

from geartrain.viewer.viewer_page import page

__all__ = ["page"]
