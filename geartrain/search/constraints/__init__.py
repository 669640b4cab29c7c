"""What else must hold of tooth counts besides ratios: assembly, clearance, interference, sums; count constraints."""
