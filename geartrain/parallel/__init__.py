"""Independent work on one machine or many: which executor runs it, and what is kept when it is cut."""
