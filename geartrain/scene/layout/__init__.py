"""Positions of axes and wheels, as declared, or such that meshing wheels touch and other wheels do not collide.

`lay_out` in `train_layout` runs the steps below in this order. The right column is the result of each step.

    declared_geometry   axes as lines, pairs of wheels               DeclaredGeometry
    wheel_modules       union-find of ratios; closed chains          WheelModules
                        radii, seats of crossing pairs               SizedGeometry
    wheel_reach         extent of the bodies of wheels
    parallel_groups     groups of parallel axes, one by one          Arrangement
                        broad wheels, by backtracking                AxialSlots
        plan_search     distances that a plan must satisfy           PlanProblem
                        beam search: order, clearance                positions in plan
        swept_overlap   distances while carriers turn                SweptDistances
        wheel_stacks    local search of the order of levels          StackProblem
                        heights of levels                            WheelStack
    train_layout        angles at which teeth mesh
                        violated conditions                          notices
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.scene.layout.train_layout import AxisPlace as AxisPlace
    from geartrain.scene.layout.train_layout import Layout as Layout
    from geartrain.scene.layout.train_layout import WheelPlace as WheelPlace
    from geartrain.scene.layout.train_layout import lay_out as lay_out

__getattr__, __all__ = public_names(__name__, {"train_layout": "AxisPlace Layout WheelPlace lay_out"})
