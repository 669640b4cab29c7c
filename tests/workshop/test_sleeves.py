"""Spacers and collets: from face to face, tight on their arbors, in nobody's way."""

from __future__ import annotations

import pytest
from shipped import train as load

from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.workshop.export.assembly_guide import assembly_steps

manifold3d = pytest.importorskip("manifold3d")

from test_built_parts import body  # noqa: E402  # without manifold3d there is no such module


def heights(work: SolidModel) -> dict[str, tuple[float, float]]:
    return {part.name: (part.placed.vertices[:, 2].min(), part.placed.vertices[:, 2].max()) for part in work.parts}


@pytest.fixture(scope="module", params=["longcase-clock-cycloidal", "freeth-2006", "price-1974"])
def work(request: pytest.FixtureRequest) -> SolidModel:
    train = load(request.param)
    return SolidModel(train, ManufacturingSizes(), train.declaration.state_or_first(None))


def test_a_spacer_goes_from_face_to_face(work: SolidModel) -> None:
    faces = heights(work)
    spacers = [part for part in work.parts if part.kind == "spacer"]
    assert spacers
    for part in spacers:
        below, above = part.name.removeprefix("spacer ").split(" to ")
        assert faces[part.name] == pytest.approx((faces[below][1], faces[above][0]), abs=1e-9)


def test_a_collet_stands_at_a_face_of_its_wheel(work: SolidModel) -> None:
    faces = heights(work)
    collets = [part for part in work.parts if part.kind == "collet"]
    assert collets
    for part in collets:
        (low, high), (bottom, top) = faces[part.name], faces[part.name.removeprefix("collet of ")]
        assert low == pytest.approx(top, abs=1e-9) or high == pytest.approx(bottom, abs=1e-9)
        assert high - low >= 0.5 - 1e-9


def test_their_holes_are_those_of_the_wheels_beside_them(work: SolidModel) -> None:
    for part in work.parts:
        if part.kind in ("spacer", "collet"):
            assert part.turned is not None
            names = part.name.removeprefix("spacer ").removeprefix("collet of ").split(" to ")
            bored = [work.blanks.wheels[name].bore for name in names if name in work.blanks.wheels]
            for bore in bored:
                assert bore == 0 or 2 * part.turned.bands[0].bore == pytest.approx(bore)
            assert part.turned.bands[0].radius - part.turned.bands[0].bore >= 0.6 - 1e-9


def test_they_stand_in_nothing(work: SolidModel) -> None:
    """Solids against solids by manifold3d, their own arbors and wheels too."""
    bodies = [(part, body(part.placed)) for part in work.parts]
    for part, solid in bodies:
        if part.kind not in ("spacer", "collet"):
            continue
        for other, foreign in bodies:
            if other is part:
                continue
            a, b = solid.bounding_box(), foreign.bounding_box()
            if all(a[k] < b[k + 3] and b[k] < a[k + 3] for k in range(3)):
                shared = (solid ^ foreign).volume()
                assert shared <= 1e-6 * solid.volume(), f"{part.name} stands in {other.name}"


def test_steps_of_the_assembly_bring_them_in_with_their_wheels(work: SolidModel) -> None:
    steps = assembly_steps(work)
    brought = [name for step in steps for name in step.parts]
    for part in work.parts:
        if part.kind in ("spacer", "collet"):
            assert brought.count(part.name) == 1
            (step,) = (step for step in steps if part.name in step.parts)
            assert ("spacer" if part.kind == "spacer" else "collet") in step.text


def test_wheels_beside_pins_and_slots_have_none() -> None:
    work = SolidModel(load("freeth-2008"), ManufacturingSizes())
    coupled = {link for each in work.train.declaration.couplings for link in (each.pin, each.slot)}
    assert coupled
    sleeves = [part for part in work.parts if part.kind in ("spacer", "collet") and part.turned is not None]
    assert not coupled & {part.turned.link for part in sleeves if part.turned is not None}
