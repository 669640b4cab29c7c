"""Tooth counts in doubt: Bayes' theorem for counts, by an exact join or a sample.

inference_problem    the question: priors of wheels, observations of outputs, conditions for the train to turn
inference            which method answers it: the weighted join of `search.join`, or a sample; two wheels together
sampled_posterior    combinations drawn and judged in blocks: floats with error bounds, integers elsewhere
posterior_summary    what both methods end with, and Sobol indices of the outputs
posterior_result     the result
"""
