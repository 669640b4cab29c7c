"""Common divisors of polynomials in several variables, exact.

Formulas of trains are short once wheels are grouped: all shipped trains with all wheels free spend 4 % of their time
here and on determinants. FLINT (python-flint) finds the divisors of long random products many times faster, but handing
it these short ones and taking them back costs 1.4 to 2 times what is done here; sympy takes 2.4 to 15 times.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction
from heapq import heapify, heappop, heappush

from geartrain.kinematics.formulas import laurent
from geartrain.kinematics.formulas.laurent import Exponents, Laurent, TooLongError
from geartrain.numerics.elimination import PRIME


def divide(p: Laurent, q: Laurent) -> Laurent | None:
    """p / q if q divides p among Laurent polynomials, else None. q is not 0."""
    if q.is_unit:
        return p * q.inverse()
    low_p, low_q = p.lowest(), q.lowest()
    rest = dict(p.shifted(_minus(low_p)).terms)
    divisor = q.shifted(_minus(low_q)).terms
    lead = max(divisor)
    queue = [_minus(exponents) for exponents in rest]  # a heap gives its least: the highest powers
    heapify(queue)
    found: dict[Exponents, Fraction] = {}
    while queue:
        top = _minus(heappop(queue))
        if top not in rest:
            continue
        step = tuple(map(int.__sub__, top, lead))
        if min(step, default=0) < 0:
            return None
        if len(found) * len(divisor) > laurent.MOST_PRODUCTS:
            raise TooLongError
        factor = found[step] = rest[top] / divisor[lead]
        for exponents, value in divisor.items():
            at = tuple(map(int.__add__, exponents, step))
            if at not in rest:
                heappush(queue, _minus(at))
            new = rest.get(at, Fraction(0)) - factor * value
            if new:
                rest[at] = new
            else:
                del rest[at]
    return Laurent(p.width, found).shifted(tuple(map(int.__sub__, low_p, low_q)))


def common_divisor(p: Laurent, q: Laurent) -> Laurent:
    """The greatest common divisor among Laurent polynomials, primitive; 1 where there is none.

    Primitive remainders in one variable after another, over the rationals; that nothing is common is mostly seen at
    once, by the remainders of images modulo a prime, whose degree is never too small.
    """
    p, q = p.primitive(), q.primitive()
    if not p or not q:
        return p if p else q
    shared = [at for at in range(p.width) if _degree(p, at) and _degree(q, at)]
    shared = [at for at in shared if _may_share(p, q, at)]
    if not shared:
        return Laurent.constant(1, p.width)
    for whole, other in ((p, q), (q, p)):
        if len(whole) <= len(other) and divide(other, whole) is not None:
            return whole
    # in the variable of least degree Euclid's algorithm takes the fewest steps
    return _remainders(p, q, min(shared, key=lambda at: min(_degree(p, at), _degree(q, at))))


def _remainders(p: Laurent, q: Laurent, at: int) -> Laurent:
    """Euclid's algorithm in one variable, the contents (in the others) apart."""
    content_p, content_q = _content(p, at), _content(q, at)
    content = common_divisor(content_p, content_q)
    p, q = _exactly(p, content_p), _exactly(q, content_q)
    if _degree(p, at) < _degree(q, at):
        p, q = q, p
    while True:
        rest = _pseudo_remainder(p, q, at)
        if not rest:
            return (content * q).primitive()
        if not _degree(rest, at):
            return content
        p, q = q, _exactly(rest, _content(rest, at)).primitive()


def _pseudo_remainder(p: Laurent, q: Laurent, at: int) -> Laurent:
    """The remainder of a multiple of p by q, as polynomials in one variable."""
    degree = _degree(q, at)
    lead = _coefficient(q, at, degree)
    while p and _degree(p, at) >= degree:
        high = _degree(p, at)
        step = tuple((high - degree) * (other == at) for other in range(p.width))
        p = p * lead - (q * _coefficient(p, at, high)).shifted(step)
    return p


def _content(p: Laurent, at: int) -> Laurent:
    """The common divisor of the coefficients of p as a polynomial in one variable."""
    found = Laurent.constant(0, p.width)
    for power in {exponents[at] for exponents in p.terms}:
        found = common_divisor(found, _coefficient(p, at, power))
        if found.is_constant:
            break
    return found


def _coefficient(p: Laurent, at: int, power: int) -> Laurent:
    chosen = {exponents: value for exponents, value in p.terms.items() if exponents[at] == power}
    return Laurent(p.width, chosen).shifted(tuple(-power * (other == at) for other in range(p.width)))


def _degree(p: Laurent, at: int) -> int:
    return max(exponents[at] for exponents in p.terms) if p else 0


def _exactly(p: Laurent, q: Laurent) -> Laurent:
    found = divide(p, q)
    assert found is not None, "a content divides what it is the content of"
    return found


def _minus(exponents: Exponents) -> Exponents:
    return tuple(-power for power in exponents)


def _may_share(p: Laurent, q: Laurent, at: int) -> bool:
    """False only if no common divisor holds the variable: the others are given numbers modulo a prime."""
    draw = random.Random(len(p) * 1000 + len(q))
    # at a random point the degree of the common divisor may come out too large, never too small
    point = [draw.randrange(1, PRIME) for _ in range(p.width)]
    left, right = (_image(each, at, point) for each in (p, q))
    if len(left) <= _degree(p, at) and len(right) <= _degree(q, at):
        return True  # both leading coefficients vanish by accident: nothing is known
    while right:
        left, right = right, _remainder(left, right)
    return len(left) > 1


def _image(p: Laurent, at: int, point: Sequence[int]) -> list[int]:
    """Coefficients by power, modulo the prime, without zeros at the end."""
    image = [0] * (_degree(p, at) + 1)
    for exponents, value in p.terms.items():
        alone = Laurent(p.width, {tuple(0 if o == at else e for o, e in enumerate(exponents)): value})
        image[exponents[at]] = (image[exponents[at]] + alone.modulo(point, PRIME)) % PRIME
    return _trimmed(image)


def _remainder(p: Sequence[int], q: Sequence[int]) -> list[int]:
    """Remainder of univariate polynomials modulo the prime."""
    rest = list(p)
    inverse = pow(q[-1], -1, PRIME)
    while len(rest) >= len(q):
        factor = rest[-1] * inverse % PRIME
        start = len(rest) - len(q)
        for at, value in enumerate(q):
            rest[start + at] = (rest[start + at] - factor * value) % PRIME
        rest = _trimmed(rest[:-1])
    return rest


def _trimmed(values: list[int]) -> list[int]:
    while values and not values[-1]:
        values.pop()
    return values
