"""One page of HTML in which a train turns; pictures and films of it.

In: one or two scenes of `geartrain.scene`. Out: one self-contained page, with the scene's data and the program that
shows them; it computes angles as `geartrain.scene` says, exactly at any number of turns. Pictures and films are that
page too, drawn moment by moment by a browser on this machine.
"""

from __future__ import annotations

from geartrain.viewer.film_frames import film
from geartrain.viewer.shot import Shot
from geartrain.viewer.viewer_page import EmbeddedPage, frame_of, page, train_page

__all__ = ["EmbeddedPage", "Shot", "film", "frame_of", "page", "train_page"]
