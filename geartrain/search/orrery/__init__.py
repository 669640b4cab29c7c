"""Several periods from one arbor with few wheels."""
