"""Search for the tooth counts of the free wheels of a train: all assignments that satisfy every requirement."""
