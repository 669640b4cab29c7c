"""What a fitter asks of tooth counts besides ratios, as equations and conditions."""

from geartrain.synthesis.rules.asked import Rules, read_rules
from geartrain.synthesis.rules.finding import Rule, find_rules

__all__ = ["Rule", "Rules", "find_rules", "read_rules"]
