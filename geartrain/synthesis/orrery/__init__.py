"""Several periods from one arbor with few wheels."""

from geartrain.synthesis.orrery.orrery_result import Orrery
from geartrain.synthesis.orrery.orrery_search import find_orrery

__all__ = ["Orrery", "find_orrery"]
