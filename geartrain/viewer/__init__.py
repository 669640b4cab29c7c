"""The interactive page: one file of HTML in which a train turns.

In: one or two scenes of `geartrain.scene`. Out: one self-contained page, with the scene's data and the program that
shows them; it computes angles as `geartrain.scene` says, exactly at any number of turns. Pictures and films are saved
from the page, by its own buttons.
"""

from __future__ import annotations

from geartrain.viewer.viewer_page import EmbeddedPage, frame_of, page, train_page

__all__ = ["EmbeddedPage", "frame_of", "page", "train_page"]
