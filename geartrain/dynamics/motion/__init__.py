"""Motion with real teeth and pins: errors of pairs composed through the whole train (docs/motion.md)."""
