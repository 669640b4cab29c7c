"""Mean angles of the sky, and trains that are set to them, compared with the orbits of E. M. Standish (JPL)."""

from __future__ import annotations

import re
from fractions import Fraction
from math import atan2, cos, degrees, radians, sin, sqrt

import pytest
import shipped
from julian_days import julian_day

from geartrain import GearTrain, load
from geartrain.drawing.dial_faces import pointer_readings
from geartrain.errors import DeclarationError
from geartrain.scene import build_scene
from geartrain.train.sky import angle_at, read_sky_angle

# E. M. Standish, Keplerian elements for approximate positions of the major planets, Solar System Dynamics Group, JPL,
# tables 2a and 2b (3000 BC to 3000 AD; mean ecliptic and equinox of J2000): a, e, I, L, perihelion, node, then their
# rates per century, then the coefficients b, c, s, f of the mean anomaly
TABLE = """
mercury 0.38709843 0.20563661 7.00559432 252.25166724 77.45771895 48.33961819
 0.0 0.00002123 -0.00590158 149472.67486623 0.15940013 -0.12214182 0 0 0 0
venus 0.72332102 0.00676399 3.39777545 181.97970850 131.76755713 76.67261496
 -0.00000026 -0.00005107 0.00043494 58517.81560260 0.05679648 -0.27274174 0 0 0 0
earth 1.00000018 0.01673163 -0.00054346 100.46691572 102.93005885 -5.11260389
 -0.00000003 -0.00003661 -0.01337178 35999.37306329 0.31795260 -0.24123856 0 0 0 0
mars 1.52371243 0.09336511 1.85181869 -4.56813164 -23.91744784 49.71320984
 0.00000097 0.00009149 -0.00724757 19140.29934243 0.45223625 -0.26852431 0 0 0 0
jupiter 5.20248019 0.04853590 1.29861416 34.33479152 14.27495244 100.29282654
 -0.00002864 0.00018026 -0.00322699 3034.90371757 0.18199196 0.13024619 -0.00012452 0.06064060 -0.35635438 38.35125000
saturn 9.54149883 0.05550825 2.49424102 50.07571329 92.86136063 113.63998702
 -0.00003065 -0.00032044 0.00451969 1222.11494724 0.54179478 -0.25015002 0.00025899 -0.13434469 0.87320147 38.35125000
"""
STANDISH = {
    words[0]: [float(each) for each in words[1:]]
    for words in (each.split() for each in re.split(r"\n(?=[a-z])", TABLE.strip()))
}
INFERIOR, SUPERIOR = ("mercury", "venus"), ("mars", "jupiter", "saturn")
# distance of the pin over the distance of the axes, or the reverse: supplement of Freeth et al. 2021, table S9
EPICYCLE = {
    "mercury": 14.04 / 36,
    "venus": 20.01 / 27.8,
    "mars": 6.58 / 10,
    "jupiter": 1.58 / 8.22,
    "saturn": 1.5 / 14.37,
}
DATES = ["-204-05-12", "150-07-01", "1000-03-03", "1681-11-15", "2026-11-28"]


def centuries(day: Fraction) -> float:
    """Return the centuries of Terrestrial Time since J2000.0; it was about 3.6 h ahead in 205 BC."""
    year = 2000 + (float(day) - 2451545) / 365.25
    return (float(day) - 2451545 + (32 * ((year - 1820) / 100) ** 2 - 20) / 86400) / 36525


def precession(t: float) -> float:
    """Return the general precession in longitude from J2000 [deg]: Lieske et al. 1977, A&A 58:1."""
    return (5029.0966 * t + 1.11113 * t**2) / 3600


def mean_longitude(body: str, day: Fraction) -> float:
    """Return the mean longitude from the equinox of the date [deg], with the long-period term of Jupiter and Saturn."""
    t = centuries(day)
    row = STANDISH[body]
    b, c, s, f = row[12:]
    return row[3] + row[9] * t + b * t * t + c * cos(radians(f * t)) + s * sin(radians(f * t)) + precession(t)


def place(body: str, day: Fraction) -> tuple[float, float]:
    """Return the heliocentric position in the plane of the ecliptic of J2000 [au]."""
    t = centuries(day)
    row = STANDISH[body]
    a, e, i, _, perihelion, node = (x + rate * t for x, rate in zip(row[:6], row[6:12], strict=True))
    M = radians(mean_longitude(body, day) - precession(t) - perihelion)
    E = M
    for _ in range(50):
        E = M + e * sin(E)
    x, y = a * (cos(E) - e), a * sqrt(1 - e * e) * sin(E)
    w, o, i = radians(perihelion - node), radians(node), radians(i)
    u, v = x * cos(w) - y * sin(w), (x * sin(w) + y * cos(w)) * cos(i)
    return u * cos(o) - v * sin(o), u * sin(o) + v * cos(o)


def true_longitude(body: str, day: Fraction) -> float:
    """Return the geocentric longitude from the equinox of the date [deg]."""
    (x, y), (u, v) = (0.0, 0.0) if body == "sun" else place(body, day), place("earth", day)
    return degrees(atan2(y - v, x - u)) + precession(centuries(day))


def circular_longitude(body: str, day: Fraction) -> float:
    """Return the geocentric longitude of a planet on circles about the mean Sun [deg], with the train's radii."""
    sun, own, size = mean_longitude("earth", day) + 180, mean_longitude(body, day), EPICYCLE[body]
    deferent, epicycle = (sun, own) if body in INFERIOR else (own, sun)
    x, y = (
        cos(radians(deferent)) + size * cos(radians(epicycle)),
        sin(radians(deferent)) + size * sin(radians(epicycle)),
    )
    return degrees(atan2(y, x))


def apart(one: float, other: float) -> float:
    """Return the difference of two angles [deg], -180 to 180."""
    return (one - other + 180) % 360 - 180


@pytest.mark.parametrize("date", DATES)
def test_mean_angles_agree_with_the_orbits_of_standish(date: str) -> None:
    day = julian_day(date)
    sun = mean_longitude("earth", day) + 180
    assert apart(360 * angle_at(read_sky_angle("sun")[0], float(day)), sun) == pytest.approx(0, abs=0.05)
    for body in (*INFERIOR, *SUPERIOR):
        # the elements are secular: they omit the great inequality of Jupiter and Saturn, up to 0.4 and 0.9 degrees
        within = {"jupiter": 0.5, "saturn": 1.0}.get(body, 0.1)
        own = mean_longitude(body, day)
        found = (
            360 * angle_at(read_sky_angle(body)[0], float(day)),
            360 * angle_at(read_sky_angle(f"{body}_anomaly")[0], float(day)),
        )
        wanted = (sun, own - sun) if body in INFERIOR else (own, sun - own)
        for one, other in zip(found, wanted, strict=True):
            assert apart(one, other) == pytest.approx(0, abs=within), body


def test_mean_angles_of_the_moon_agree_with_its_phases_and_eclipses() -> None:
    # J. Meeus, Astronomical Algorithms, 1998, example 47.a: the Moon on 1992 April 12 at 0 h Terrestrial Time
    day = Fraction("2448724.5") - Fraction(59, 86400)
    for text, longitude in (("moon", 134.290182), ("moon_anomaly", 5.150833), ("moon - sun", 113.842304)):
        assert apart(360 * angle_at(read_sky_angle(text)[0], float(day)), longitude) == pytest.approx(0, abs=3e-3), text
    # the total solar eclipse of 1999 August 11 (greatest at 11:03 UT): new Moon, near the node
    day = julian_day("1999-08-11 11:03")
    assert apart(360 * angle_at(read_sky_angle("moon - sun")[0], float(day)), 0) == pytest.approx(0, abs=8)
    assert abs(apart(360 * angle_at(read_sky_angle("sun - moon_node")[0], float(day)) * 2, 0)) < 2 * 17


def longitudes(name: str, after: float) -> tuple[Fraction, dict[str, float]]:
    """Return a Julian day some days after the epoch, and the readings of a shipped train on that day [deg]."""
    scene = shipped.scene(name)
    assert scene.epoch is not None
    turns = Fraction(scene.epoch.turns) + Fraction(after) / Fraction(scene.epoch.days)
    readings = {each.output: 360 * float(each.at % 1) for each in pointer_readings(scene, turns)}
    return Fraction(scene.epoch.julian_day) + Fraction(after), readings


@pytest.mark.parametrize("after", range(0, 800, 31))
def test_planets_have_the_phase_of_their_epicycles_for_years_after_the_epoch(after: int) -> None:
    day, found = longitudes("freeth-2021", after)
    for body in EPICYCLE:
        within = {"jupiter": 0.6, "saturn": 1.0}.get(body, 0.5)
        assert apart(found[body], circular_longitude(body, day)) == pytest.approx(0, abs=within), body
    # the eccentricity of an orbit is not modelled
    for body, within in {"sun": 2.1, "mercury": 13, "venus": 6, "mars": 34, "jupiter": 7, "saturn": 9}.items():
        assert abs(apart(found[body], true_longitude(body, day))) < within, body


def test_the_moon_has_its_anomaly_and_its_phase() -> None:
    for after in range(0, 60, 3):
        day, found = longitudes("freeth-2021", after)
        mean, anomaly = (360 * angle_at(read_sky_angle(each)[0], float(day)) for each in ("moon", "moon_anomaly"))
        # the slot is ahead by atan2(e sin, r - e cos) of the anomaly, with 1.1 and 9.6 mm (Freeth et al. 2006)
        swing = degrees(atan2(1.1 * sin(radians(anomaly)), 9.6 - 1.1 * cos(radians(anomaly))))
        assert apart(found["moon"], mean + swing) == pytest.approx(0, abs=0.02)
        # the ball turns against its reader's sense
        assert apart(-found["phase"], found["moon"] - found["sun"]) == pytest.approx(0, abs=0.02)


SUN = """
name: sun
frame: frame
unit: {per: year_tropical_J2000}
epoch: {date: 2000-01-01, turns: 1/4}
dials: {zodiac: {names: zodiac, counted: COUNTED}}
links: {frame: {}, a: {wheels: {x: 10}}, b: {wheels: {y: 10}}}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [x ~ y]
inputs: {a: 1}
outputs: {a: {at_epoch: AT, dial: zodiac}, b: {}}
"""


@pytest.mark.parametrize("counted", ["clockwise", "counter-clockwise"])
@pytest.mark.parametrize(("at", "longitude"), [("33.1 deg", 33.1), ("sun", 280.46646), ("- sun + 20 deg", 99.53354)])
def test_an_output_reads_its_angle_at_the_epoch_along_its_scale(counted: str, at: str, longitude: float) -> None:
    scene = build_scene(load(SUN.replace("COUNTED", counted).replace("AT", f'"{at}"')))
    (reading,) = (each for each in pointer_readings(scene, Fraction(1, 4)) if each.output == "a")
    way = 1 if counted == "clockwise" else -1
    assert apart(way * 360 * float(reading.at), longitude) == pytest.approx(0, abs=1e-3)
    assert scene.epoch is not None
    assert (scene.epoch.unset, len(scene.epoch.settings)) == ((), 1)


@pytest.mark.parametrize(
    ("outputs", "said"),
    [
        ("{a: {at_epoch: sol}}", "'sol' is not an angle of the sky"),
        ("{a: {at_epoch: sun moon}}", "'sun moon' is not an angle"),
        ("{a: {at_epoch: 33.1}}", "'33.1' is not an angle"),
        ("{a: {at_epoch: sun}, again: {of: a, at_epoch: moon}}", "'a' and 'again' both need 'a'"),
        ("{rel: {of: b, relative_to: a, at_epoch: sun}, a: {at_epoch: moon}}", "'rel' and 'a' both need 'a'"),
    ],
)
def test_what_is_not_an_angle_is_refused(outputs: str, said: str) -> None:
    with pytest.raises(DeclarationError, match=said):
        load(SUN.replace("COUNTED", "clockwise").replace("{a: {at_epoch: AT, dial: zodiac}, b: {}}", outputs))


def test_a_setting_changes_the_scene_only() -> None:
    train = shipped.train("freeth-2008")
    unset = GearTrain(train.declaration.changed(epoch=None))
    assert unset.solve() == train.solve()
    moved, without = (each.motion(outputs=["moon"]).at([0.3]).error for each in (train, unset))
    assert (moved == without).all()
    assert shipped.scene("freeth-2008").bodies[1].start == 0  # only links of set outputs start elsewhere
