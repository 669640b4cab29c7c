"""Time steps of a train with contacts, in compiled kernels (docs/dynamics.md, 4 and 6).

time_steps         rigid teeth: nonsmooth time stepping (Moreau-Jean), complementarity problem of contacts, impacts;
                   compliant teeth: implicit midpoint rule
contact_solution   speeds and impulses of a step for one guess of the contacts, by a system of linear equations
step_account       energy balance of a step, times in contact, impacts
simulation         plan, intervals and results of a simulated run
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.simulation.steps.contact_solution import BEARINGS as BEARINGS
    from geartrain.simulation.steps.contact_solution import GAP as GAP
    from geartrain.simulation.steps.contact_solution import IMPACT_COUNT as IMPACT_COUNT
    from geartrain.simulation.steps.contact_solution import TIME_APART as TIME_APART
    from geartrain.simulation.steps.contact_solution import UNSOLVED as UNSOLVED
    from geartrain.simulation.steps.contact_solution import WORK_DRIVE as WORK_DRIVE
    from geartrain.simulation.steps.simulation import StepPlan as StepPlan
    from geartrain.simulation.steps.simulation import simulate as simulate

__getattr__, __all__ = public_names(
    __name__,
    {
        "contact_solution": "BEARINGS GAP IMPACT_COUNT TIME_APART UNSOLVED WORK_DRIVE",
        "simulation": "StepPlan simulate",
    },
)
