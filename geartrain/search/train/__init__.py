"""Search for tooth counts of a train: all assignments of the varied wheels that satisfy every requirement.

train_search             search: requirements, constraints and varied wheels of a train
output_requirements      requirements on output speeds as exact intervals, and errors of speeds
search_passes            one pass over a part of a train: a join, divided into tasks
train_findings           results part by part, and ranks of given assignments
verb                     command `geartrain teeth train`
"""
