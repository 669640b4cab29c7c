"""Wheels, plates and pins as bodies with sizes: what a maker cuts, a printer prints and a viewer loads."""
