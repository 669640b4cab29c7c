"""What is found in time: runs and their figures, modes, the rate at which steps part teeth (docs/dynamics.md)."""
