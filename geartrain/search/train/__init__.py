"""Search for tooth counts of a train: find all tooth counts of the varied wheels that satisfy every requirement.

train_search             the search: requirements, constraints and varied wheels of a train
output_requirements      requirements on output speeds as exact intervals, and errors of output speeds
search_passes            one pass over a part of a train: a join that is divided into tasks
train_findings           results for each part, and ranks of given assignments of tooth counts
verb                     the command `geartrain teeth train`
"""
