"""Who turns how fast, exactly: from a declaration to speeds, mobility and a verdict.

In: a train's declaration, inputs, what is held. Out: fundamental circuits with their carriers, speeds as Fractions (or
floats with a bound of their error), degrees of freedom, a verdict with its witness, what could be judged of outputs.
The equation of the room is Willis': a (w_i - w_k) + b (w_j - w_k) = 0, one for each gear pair (docs/theory.md, 3 to 9).

graph                 the declared links, turning pairs and gear pairs as a networkx graph
circuits              joint tree, axes, rigid bodies, fundamental circuits
willis_system         the rows of the system, for whoever solves it
components            ordinary trains of one carrier, and the reduced system between them
speeds                propagation, exact elimination, floats
gridlock              locked subgraphs, and the fewest meshes to take out
phasing               whether teeth meet when a train is put together
judged_outputs, answer, verdict, lint   what is told of it all
"""
