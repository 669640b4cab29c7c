"""Where axes and wheels stand: positions as declared, or placed so that meshing wheels touch and nothing collides.

`train_layout` first: its `lay_out` runs the steps below in this order, and each hands a record to the next.

    declared_geometry   axes as lines, pairs of wheels           DeclaredGeometry
    wheel_modules       union-find of ratios; closed chains      WheelModules
    wheel_sizes         radii, seats of crossing pairs           SizedGeometry
    wheel_reach         how far bodies of wheels reach
    parallel_groups     groups of parallels, one by one          Arrangement
                        broad wheels, by backtracking            AxialSlots
                        wheels that keep their heights           StackProblem
        plan_problem    what is asked of a plan                  PlanProblem
        plan_search     beam search: order, clearance            places in plan
        swept_overlap   distances while carriers turn            SweptDistances, PlanOverlap
        stack_order     local search of the order of levels      keys
        wheel_stacks    heights of levels                        WheelStack
    train_layout        angles at which teeth meet               MeshAlignment
                        what could not be met                    notices
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.scene.layout.train_layout import AxisPlace as AxisPlace
    from geartrain.scene.layout.train_layout import Layout as Layout
    from geartrain.scene.layout.train_layout import WheelPlace as WheelPlace
    from geartrain.scene.layout.train_layout import lay_out as lay_out

__all__ = ["AxisPlace", "Layout", "WheelPlace", "lay_out"]

__getattr__ = lazy_names(__name__, dict.fromkeys(__all__, "train_layout"))
