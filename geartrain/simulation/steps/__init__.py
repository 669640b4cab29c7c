"""Time steps of a train with contacts, in kernels (docs/dynamics.md, 4 and 6).

time_steps         rigid teeth: nonsmooth time stepping (Moreau-Jean), the search for consistent contacts, impacts
yielding_steps     compliant teeth: the implicit midpoint rule
contact_solution   the speeds at the end of a step for one guess of contacts: elimination in the solved order
step_account       the energy account of a step, shares of time apart, impacts
simulation         a run: its plan, its stretches, its result
"""
