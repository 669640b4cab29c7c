"""One page of HTML in which a train turns."""

from __future__ import annotations

from geartrain.viewer.viewer_page import page

__all__ = ["page"]
