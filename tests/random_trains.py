"""Random trains as plain declarations, from a seed: nested carriers, bevels, clutches, pins, several inputs with units.

A train grows as a tree of turning pairs whose axis labels are correct by construction: a new link is attached to an
existing one, about an axis that it bears or about a new axis. Pairs are then drawn among the links whose path changes
axis once. Carriers can therefore be carried, planets can be equal copies (loops that close) or have separate wheels
(loops that do not), and the prescribed speeds make a train determined, free, locked or contradictory.

`random_train(seed)` draws all features. `driven_train(seed)` is always determined: its inputs are added according to
the reference solver (`joint_rates`), for tests that need a train that turns.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from random import Random
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from joint_rates import Resting

Data = dict[str, Any]
Vector = tuple[int, int, int]

Z: Vector = (0, 0, 1)
# of rational length, so that a unit vector along each is exact
SLANTED: tuple[Vector, ...] = (
    (1, 0, 0),
    (0, 1, 0),
    (-1, 0, 0),
    (0, 0, 2),
    (3, 4, 0),
    (0, -3, 4),
    (2, 3, 6),
    (0, 0, -1),
)
UNITS = ("rpm", "deg/s", "turn/d", "turn/s", "turn/h")


@dataclass(frozen=True)
class RandomTrain:
    """A declaration, and its axes in the pose in which all angles are zero.

    directions   axis label -> direction; z if none is declared
    positions    axis label -> a point of the axis, at random, so that no two axes meet by accident; declared if
    `placed`
    """

    seed: int
    data: Data
    directions: Mapping[str, Vector] = field(default_factory=dict)
    positions: Mapping[str, Vector] = field(default_factory=dict)
    placed: bool = False

    @property
    def states(self) -> tuple[str | None, ...]:
        """Names of the states; (None,) if there are none."""
        return tuple(self.data.get("states", ())) or (None,)


def random_train(seed: int, most: int = 9, oblique: bool = True, requested: bool = True) -> RandomTrain:
    """Return a train from a seed.

    most       maximum number of moving links
    oblique    whether half of the trains have axes in several directions, with bevel wheels
    requested  whether inputs, fixed links, locks, clutches, states and outputs are declared
    """
    random = Random(seed)
    grown = _Growing(random, slanted=oblique and random.random() < 0.5)
    grown.grow(random.randint(2, most))
    grown.add_pairs(random.randint(1, max(1, len(grown.links) - 2)))
    if random.random() < 0.3:
        grown.copy_a_planet()
    data = grown.data()
    placed = grown.slanted and random.random() < 0.2
    if grown.slanted:
        data["axes"] = {
            label: {"direction": list(direction), **({"position": grown.place(label)} if placed else {})}
            for label, direction in grown.directions.items()
            if placed or direction != Z
        }
    train = RandomTrain(seed, data, grown.directions, grown.positions, placed)
    if requested:
        _Requesting(random, grown, train).ask()
    return train


def driven_train(seed: int, **options: Any) -> RandomTrain:
    """Return the first train from this seed on that can be determined, with inputs until nothing is free."""
    from joint_rates import drive, inputs_of, rest

    for at in itertools.count(seed * 1000):
        found = random_train(at, requested=False, **options)
        random = Random(at)
        if random.random() < 0.3:
            found.data["fixed"] = [random.choice([link for link in found.data["links"] if _on_the_frame(found, link)])]
        resting = rest(found)
        found.data["inputs"] = inputs_until_determined(found, resting, random)
        if found.data["inputs"] and drive(resting, inputs_of(found.data, None)).kind == "determined":
            return found
    raise AssertionError("unreachable")


def inputs_until_determined(
    train: RandomTrain, resting: Resting, random: Random, write: Callable[[Fraction], str] = str, most: int = 9
) -> dict[str, str]:
    """Return inputs of a train, added one by one on free links until nothing is free or `most` links are driven."""
    from joint_rates import drive, inputs_of

    inputs: dict[str, str] = {}
    while len(inputs) < most:
        motion = drive(resting, inputs_of({"inputs": inputs}, None))
        loose = [link for link in train.data["links"] if motion.is_free(link)] if motion.kind == "free" else []
        if motion.kind == "locked" and not inputs:
            break
        if not loose:
            break
        inputs[random.choice(loose)] = write(_speed(random))
    return inputs


def _on_the_frame(train: RandomTrain, link: str) -> bool:
    """Return True if a link turns about an axis in the frame."""
    return link != "frame" and any(set(joint["pair"]) == {"frame", link} for joint in train.data["revolutes"])


class _Growing:
    """A skeleton of links and joints, to which pairs are added."""

    def __init__(self, random: Random, slanted: bool) -> None:
        self.random, self.slanted = random, slanted
        self.links: dict[str, dict[str, Any]] = {"frame": {}}
        self.parent: dict[str, tuple[str, str]] = {}
        self.directions: dict[str, Vector] = {}
        self.positions: dict[str, Vector] = {}
        self.revolutes: list[Data] = []
        self.gears: list[Data] = []
        self.couplings: list[Data] = []
        self._borne: dict[str, list[str]] = {"frame": []}
        self._shared = {}  # link -> the one wheel it has for many mates
        self._one_wheel = random.random() < 0.5

    def grow(self, count: int) -> None:
        """Add links L1, L2, ... to earlier links."""
        for at in range(1, count + 1):
            parent = self.random.choice(list(self.links))
            borne = self._borne[parent]
            if not borne or self.random.random() < 0.6:
                axis = f"A{at}"
                borne.append(axis)
                self._lay(axis, parent)
            else:
                axis = self.random.choice(borne)
            self._join(f"L{at}", parent, axis)

    def _join(self, link: str, parent: str, axis: str) -> None:
        self.links[link] = {}
        self.parent[link] = (parent, axis)
        self._borne[link] = [axis]
        pair = [parent, link]
        self.random.shuffle(pair)
        self.revolutes.append({"pair": pair, "axis": axis})

    def _lay(self, axis: str, parent: str) -> None:
        """Choose a direction, usually that of the parent's axis, and a position."""
        own = self.directions[self.parent[parent][1]] if parent in self.parent else Z
        x, y, z = own
        chosen = own
        if self.slanted and (draw := self.random.random()) < 0.45:
            chosen = (-x, -y, -z) if draw < 0.1 else self.random.choice(SLANTED)
        self.directions[axis] = chosen
        self.positions[axis] = tuple(self.random.randint(-9999, 9999) for _ in range(3))  # type: ignore[assignment]

    def place(self, label: str) -> list[str]:
        return [f"{value} mm" for value in self.positions[label]]

    def path(self, i: str, j: str) -> list[tuple[str, str]]:
        """Return the joints between two links, each as its outer link and its label."""

        def chain(link: str) -> list[tuple[str, str]]:
            found = []
            while link in self.parent:
                found.append((link, self.parent[link][1]))
                link = self.parent[link][0]
            return found

        up, down = chain(i), chain(j)
        while up and down and up[-1] == down[-1]:
            up.pop()
            down.pop()
        return up + down[::-1]

    def axes_between(self, i: str, j: str) -> list[str]:
        """Return the axis labels on the path, each once."""
        return [label for label, _ in itertools.groupby(label for _, label in self.path(i, j))]

    def parallel(self, labels: Sequence[str]) -> bool:
        return all(not any(cross(self.directions[labels[0]], self.directions[label])) for label in labels)

    def is_oblique(self, link: str) -> bool:
        """Return True if the axes between a link and the frame are not all parallel."""
        labels = self.axes_between("frame", link)
        return bool(labels) and not self.parallel(labels)

    def add_pairs(self, count: int) -> None:
        able = [pair for pair in itertools.combinations(self.links, 2) if len(self.axes_between(*pair)) == 2]
        for at in range(count if able else 0):
            i, j = self.random.sample(self.random.choice(able), 2)
            parallel = self.parallel(self.axes_between(i, j))
            if parallel and self.random.random() < 0.15:
                kind = self.random.choice(["pin_and_slot", "pin_follower"])
                self.couplings.append({"id": f"C{at}", "kind": kind, "pin": i, "slot": j})
            elif parallel:
                self.gears.append({"id": f"G{at}", "pair": self._spurs(i, j, at)})
            else:
                self.gears.append({"id": f"G{at}", "pair": [self._bevel(link, at) for link in (i, j)]})

    def _spurs(self, i: str, j: str, at: int) -> list[str]:
        if self._one_wheel and self.random.random() < 0.75:
            return [self._shared_wheel(link) for link in (i, j)]
        ring = self.random.choice([None, None, None, i, j])
        return [self._wheel(link, f"w{at}{link}", {"internal": True} if link == ring else {}) for link in (i, j)]

    def _shared_wheel(self, link: str) -> str:
        if link not in self._shared:
            self._shared[link] = self._wheel(link, f"w{link}", {})
        return self._shared[link]

    def _bevel(self, link: str, at: int) -> str:
        return self._wheel(link, f"w{at}{link}", {"kind": "bevel", "facing": self.random.choice([1, -1])})

    def _wheel(self, link: str, name: str, more: Data) -> str:
        self.links[link].setdefault("wheels", {})[name] = {"teeth": self.random.randint(8, 40), **more}
        return name

    def copy_a_planet(self) -> None:
        """Add a copy of a link on another axis with the same meshes, like an equal planet."""
        meshes: dict[str, list[tuple[int, int]]] = {}
        wheels = {name: link for link, part in self.links.items() for name in part.get("wheels", {})}
        for at, gear in enumerate(self.gears):
            for side, name in enumerate(gear["pair"]):
                meshes.setdefault(wheels[name], []).append((at, side))
        able = [
            link
            for link, used in meshes.items()
            if len(used) > 1
            and link != "frame"
            and not any(link == parent for parent, _ in self.parent.values())
            and sum(axis == self.parent[link][1] for _, axis in self.parent.values()) == 1
        ]
        if not able:
            return
        link = self.random.choice(able)
        parent, axis = self.parent[link]
        twin = f"{link}twin"
        self.directions[f"{axis}twin"] = self.directions[axis]
        self.positions[f"{axis}twin"] = tuple(self.random.randint(-9999, 9999) for _ in range(3))  # type: ignore[assignment]
        self._join(twin, parent, f"{axis}twin")
        self.links[twin] = {"wheels": {f"{name}t": dict(wheel) for name, wheel in self.links[link]["wheels"].items()}}
        for at, side in meshes[link]:
            pair = list(self.gears[at]["pair"])
            pair[side] += "t"
            self.gears.append({"id": f"{self.gears[at]['id']}t", "pair": pair})

    def data(self) -> Data:
        """Return the declaration without inputs."""
        return {
            "links": self.links,
            "revolutes": self.revolutes,
            "gears": self.gears,
            "couplings": self.couplings,
        }


class _Requesting:
    """Inputs, fixed links, locks, states and outputs of a random train."""

    def __init__(self, random: Random, grown: _Growing, train: RandomTrain) -> None:
        self.random, self.grown, self.train, self.data = random, grown, train, train.data
        self.moving = [link for link in grown.links if link != "frame"]
        self.units: tuple[str, ...] = ()
        if random.random() < 0.4:
            self.units = tuple(random.sample(UNITS, random.randint(1, 3)))

    def ask(self) -> None:
        from joint_rates import rest

        random = self.random
        self.data["fixed"] = self._fixed(0.3)
        self.data["locks"] = self._locks(0.2)
        if random.random() < 0.6:
            most = random.randint(1, 4)
            self.data["inputs"] = inputs_until_determined(self.train, rest(self.train), random, self._given, most)
        else:
            self.data["inputs"] = self._inputs(random.choice([0, 0, 1, 1, 2, 2, 3]))
        if random.random() < 0.3:
            self._states()
        names = [f"o{at}" for at in range(3)]
        self.data["outputs"] = {name: self._output() for name in names}

    def _states(self) -> None:
        random = self.random
        clutches: Data = {}
        for at in range(random.randint(1, 4)):
            lock = self._locks(0.6)
            clutches[f"K{at}"] = {"locks": lock[0]} if lock else {"fixes": random.choice(self.moving)}
        self.data["clutches"] = clutches
        self.data["states"] = {}
        for at in range(random.randint(1, 3)):
            state: Data = {"engaged": random.sample(list(clutches), random.randint(0, min(2, len(clutches))))}
            if random.random() < 0.3:
                state["inputs"] = self._inputs(random.randint(0, 2))
            if random.random() < 0.2:
                state["fixed"] = self._fixed(0.5)
            if random.random() < 0.2:
                state["locks"] = self._locks(0.5)
            self.data["states"][f"S{at}"] = state

    def _inputs(self, count: int) -> Data:
        able = [link for link in self.moving if not self.grown.is_oblique(link)]
        chosen = self.random.sample(able, min(count, len(able)))
        return {link: self._given(_speed(self.random)) for link in chosen}

    def _given(self, speed: Fraction) -> str:
        if not self.units or (not speed and self.random.random() < 0.5):
            return str(speed)
        return f"{speed} {self.random.choice(self.units)}"

    def _fixed(self, chance: float) -> list[str]:
        return [self.random.choice(list(self.grown.links))] if self.random.random() < chance else []

    def _locks(self, chance: float) -> list[list[str]]:
        if len(self.moving) < 2 or self.random.random() > chance:
            return []
        pair = self.random.sample(self.moving, 2)
        # of the links far apart, which make linkages, only some
        for _ in range(3):
            if len(self.grown.axes_between(*pair)) <= 2:
                break
            pair = self.random.sample(self.moving, 2)
        return [pair]

    def _output(self) -> Data:
        of, base = self.random.choices(list(self.grown.links), k=2)
        return {"of": of, **({"relative_to": base} if self.random.random() < 0.7 else {})}


def _speed(random: Random) -> Fraction:
    if random.random() < 0.15:
        return Fraction(0)
    return Fraction(random.choice([-1, 1]) * random.randint(1, 12), random.randint(1, 4))


def cross(u: Sequence[Any], v: Sequence[Any]) -> tuple[Any, Any, Any]:
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def many(count: int, first: int = 0, **options: Any) -> Iterator[RandomTrain]:
    """Yield random trains from consecutive seeds."""
    return (random_train(seed, **options) for seed in range(first, first + count))
