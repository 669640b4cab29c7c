"""Special roles given out to arbors, as numbered states: those that some core of an added structure has still."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.reconstruction.added_structures import Core
from geartrain.synthesis.reconstruction.arbor_roles import Role
from geartrain.synthesis.reconstruction.prime_shares import NO_STATE
from geartrain.synthesis.reconstruction.train_rows import States

_State = tuple[Role | None, tuple[Role, ...], tuple[Core, ...]]
"""What the input arbor is, the special roles given out, and the cores that have them."""


class CoreStates:
    """States of the cores of some added wheels."""

    start = 1

    def __init__(self, cores: Sequence[Core]) -> None:
        self._known: list[_State] = [(None, (), ()), (None, (), tuple(cores))]
        self._numbers: dict[tuple[Role | None, tuple[Role, ...]], int] = {(None, ()): 1}
        self._steps: dict[tuple[int, Role, bool], int] = {}

    def after(self, states: States, role: Role, is_input: bool) -> States:
        """Each state once an arbor more has a role."""
        if not (is_input or role.is_special):
            return states
        known, which = np.unique(states, return_inverse=True)
        steps = [self._step(int(state), role, is_input) for state in known]
        return np.array(steps, dtype=np.int32)[which]

    def are_whole(self, states: States) -> NDArray[np.bool_]:
        """Whether nothing of a core is left to be given out."""
        known, which = np.unique(states, return_inverse=True)
        whole = [any(core == self._known[state][:2] for core in self._known[state][2]) for state in known]
        return np.array(whole, dtype=bool)[which]

    def _step(self, state: int, role: Role, is_input: bool) -> int:
        key = state, role, is_input
        if key not in self._steps:
            root, roles, cores = self._known[state]
            if is_input:
                root, left = role, tuple(core for core in cores if core[0] == role)
            else:
                roles = tuple(sorted((*roles, role)))
                left = tuple(core for core in cores if core[1].count(role) >= roles.count(role))
            self._steps[key] = self._number(root, roles, left) if left else NO_STATE
        return self._steps[key]

    def _number(self, root: Role | None, roles: tuple[Role, ...], cores: tuple[Core, ...]) -> int:
        known = root, roles
        if known not in self._numbers:
            self._numbers[known] = len(self._known)
            self._known.append((root, roles, cores))
        return self._numbers[known]
