"""Motion in time: inertia, play, blows, drag and friction, stepped after Moreau and Jean (docs/dynamics.md)."""
