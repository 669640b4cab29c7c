"""Bayesian inference of uncertain tooth counts, by an exact join or by sampling.

inference_problem    the inference problem: priors of tooth counts, observations of outputs, conditions for the train to
                     turn
inference            choice of the method: weighted join of `search.join`, or sampling; joint posteriors of pairs
sampled_posterior    likelihood of sampled combinations, compared in floating point, or exactly near the bounds
posterior_summary    results common to both methods, and Sobol indices of the outputs
posterior_result     the result of the inference
"""
