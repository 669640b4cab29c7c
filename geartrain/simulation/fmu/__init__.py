"""Co-simulation units (FMI) of a train that moves in time: the file, and the slave that runs in it."""
