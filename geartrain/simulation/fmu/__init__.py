"""Co-simulation units (FMI) of a train that is simulated in time: creation of the file, and the slave in the file."""
