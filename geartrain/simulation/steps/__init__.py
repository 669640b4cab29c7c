"""What steps: the equations of a step, the search for what touches, the account (docs/dynamics.md, section 4)."""
