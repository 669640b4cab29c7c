"""Co-simulation units (FMI) of a train that moves in time: creation of the file, and the slave inside it."""
