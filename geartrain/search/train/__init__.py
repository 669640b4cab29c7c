"""Search for tooth counts of a train: all assignments of the varied wheels that satisfy every requirement."""
