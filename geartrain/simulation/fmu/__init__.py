"""Co-simulation units (FMI) of a train simulated in time: creation of the file, and the slave inside it."""
