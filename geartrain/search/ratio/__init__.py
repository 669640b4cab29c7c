"""One ratio by one to five stages of gear pairs: complete, or the best, proved."""

from geartrain.search.ratio.stage_problem import StageConstraints
from geartrain.search.ratio.stage_search import StageFindings, find_stages

__all__ = ["StageConstraints", "StageFindings", "find_stages"]
