"""Search for a gear train that shows several periods from one arbor with few wheels."""
