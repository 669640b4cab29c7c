"""Interactive page of a train: one HTML file with an animated, three-dimensional view.

Input is one or more scenes of `geartrain.scene`. Output is a self-contained page with the data of the scenes and the
program that displays them; it computes angles exactly at any number of revolutions. Pictures and films are saved with
buttons of the page.
"""

from __future__ import annotations

from geartrain.viewer.viewer_page import EmbeddedPage, frame_of, page, train_page

__all__ = ["EmbeddedPage", "frame_of", "page", "train_page"]
