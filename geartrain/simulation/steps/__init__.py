"""Time steps of a train with contacts: implicit Euler with complementarity, in kernels (docs/dynamics.md, 4 and 6).

contact_solution   the speeds at the end of a step for one guess of contacts, and the correction of the guess
time_steps         steps of rigid teeth: the search for the contacts that are consistent, and impacts
yielding_steps     steps of compliant teeth
step_account       the energy account of a step, and the record of a run
simulation         a run: its plan, its stretches, its result
"""
