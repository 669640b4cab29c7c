"""One ratio by one to five stages of gear pairs: complete, or the best, proved."""

from geartrain.synthesis.stages.finding import find_stages
from geartrain.synthesis.stages.findings import StageFindings
from geartrain.synthesis.stages.fit import Fit

__all__ = ["Fit", "StageFindings", "find_stages"]
