"""Tooth counts in doubt: Bayes' theorem for counts, by an exact join or a sample.

priors, observations        what is assumed of each wheel, and what is known of the outputs
inference_problem           both together for one train, and what must hold for it to turn
inference                   the question, which method answers it, and the joint posterior of two wheels
exact_posterior             the weighted join of `search.join`, in whole numbers
sampled_posterior           combinations drawn and judged in blocks: likelihood, monomial_columns
posterior_summary, posterior_result   what comes out
variance_shares             which wheel decides an output
"""
