"""Inertia of links, and up to which rate motion holds in spite of it (docs/dynamics.md, sections 1 and 3)."""
