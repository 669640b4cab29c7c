"""Time steps of a train with contacts, in compiled kernels (docs/dynamics.md, 4 and 6).

time_steps         rigid teeth: nonsmooth time stepping (Moreau-Jean), complementarity problem of contacts, impacts;
                   compliant teeth: implicit midpoint rule
contact_solution   speeds and impulses of a step for one guess of the contacts, by a system of linear equations
step_account       energy balance of a step, times in contact, impacts
simulation         plan, intervals and results of a simulated run
"""
