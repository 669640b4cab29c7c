"""What cannot be requested is refused before anything is written: place, what, why and fix, for every command."""

from __future__ import annotations

import shlex
from pathlib import Path
from textwrap import dedent

import pytest
from commands import HEAVY, ended
from test_montecarlo_command import PAIR
from test_posterior_command import TRAIN
from test_teeth_command import HANDS

FILES = {"pair.yaml": dedent(PAIR), "doubt.yaml": TRAIN, "hands.yaml": HANDS, "pin.yaml": HEAVY}
"""Small trains on which the commands are requested."""
REFUSED = """
# montecarlo
montecarlo pair.yaml --trials 64 --trials 0 | 0 is not a valid number of trials
montecarlo pair.yaml --trials 64 --trials -5 | -5 is not a valid number of trials
montecarlo pair.yaml --trials 64 --cutting 'pitch_deviation=120 %' | tooth vanishes
montecarlo pair.yaml --trials 64 --cutting 'pitch_deviation=20 deg' | tooth vanishes
montecarlo pair.yaml --trials 64 --cutting 'tip=0.1 mm' | needs a module
montecarlo pair.yaml --trials 64 --cutting 'colour=3 %' | is not a valid error specification
montecarlo pair.yaml --trials 64 --cutting 'pitch_deviation=3 apples' | is not a valid error specification
montecarlo pair.yaml --trials 64 --cutting 'pitch_deviation=-3 %' | is negative
montecarlo pair.yaml --trials 64 --cutting 'x9.pitch_deviation=3 %' | wheel 'x9'
montecarlo pair.yaml --trials 64 --cutting 'p.centre=3 %' | pair 'p'
montecarlo pair.yaml --trials 64 --cutting pitch_deviation=0 | declares no manufacturing errors
montecarlo pair.yaml --trials 64 --of nothing | no output or link
montecarlo pair.yaml --trials 64 --state fast | no state
montecarlo pair.yaml --trials 64 --vary clearance_factor=1.03:1.01:3 | not a sweep
montecarlo pair.yaml --trials 64 --vary window=0.5:1.5:3 | not a sweep
montecarlo pair.yaml --trials 64 --vary clearance_factor=a:b | not a sweep
montecarlo pair.yaml --workers 0 | error: --workers:
montecarlo pair.yaml --workers x | error: --workers:
montecarlo pair.yaml --workers 2.5 | error: --workers:

# feasibility
feasibility pair.yaml --accuracy 0.3:0.1:4 | is not a sweep of values
feasibility pair.yaml --accuracy many | is not a sweep of values
feasibility pair.yaml --plot curve.svg | the curve that it shows is missing
feasibility pair.yaml --trials 0 | is not a valid number of trials

# posterior
posterior doubt.yaml --free w=22:18 | --free: the range 22:18 is reversed
posterior doubt.yaml --free w | --free: 'w' is not a wheel with counts
posterior doubt.yaml --free w=many | --free: 'many' is not a tooth count
posterior doubt.yaml --tolerance '2 mm' | --tolerance: '2 mm' is a length, but a fraction or a clock rate is required
posterior doubt.yaml -o out.stl | -o: '.stl' is not an output format of this option

# teeth
teeth ratio 13.3683x | only one count
teeth ratio months_per_yea | did you mean
teeth ratio 3 --range 5:2 | reversed
teeth set 3 --kind planetry | 'planetry' is not a kind
teeth ratio 3 --sort size | cannot be sorted
teeth ratio 3 --tolerance -1 | tolerance
teeth train hands.yaml --free nut,screw | screw
teeth train hands.yaml --where nut | W=32
teeth approximants 3 -o x.yaml | as a declaration
teeth orrery moon=29.5 29.5 | moon=29.53
teeth orrery venus=venus_synodic_per_year_289_in_462 | is a speed, not a period
teeth train hands.yaml --range 12:20 | --range
teeth train hands.yaml -o hands.yaml --force | the input file
teeth train hands.yaml --tolerance -1 | --tolerance
teeth ratio 235/19 --minimum 20 | --minimum
teeth ratio 235/19 --planets 3 | --planets
teeth ratio 235/19 --tolerance 1e400 | --tolerance
teeth ratio 235/19 --tolrance 1e-6 | --tolrance
teeth set 4 --kind planetary --hunting | --hunting
teeth set 4 --kind planetary --clearance 1 | --planets
teeth orrery moon=29.5 --sort total | --sort
teeth orrery moon=-29.5 | sense
teeth 5.31 --stages 1 | `geartrain teeth ratio 5.31 --stages 1`
teeth -235/19 | `geartrain teeth ratio -235/19`
teeth hands.yaml --sort total | `geartrain teeth train hands.yaml --sort total`
teeth pennestri-2002-missing | `geartrain teeth train pennestri-2002-missing`
teeth 365.2422 --approximants --range 1:400 | `geartrain teeth approximants 365.2422 --range 1:400`
teeth --kind list any | `geartrain teeth set --kind list any`
teeth 142 --kind wolfrom | `geartrain teeth set 142 --kind wolfrom`
teeth moon=29.53 venus=224.7 | `geartrain teeth orrery moon=29.53 venus=224.7`
teeth orery moon=29.53 | did you mean 'orrery'?
teeth ratio 1e-29 --stages 1 --range 12:200000 | cannot be approximated
teeth ratio 1e300 --stages 1 --range 12:200000 | from 1e-30 to 1e30

teeth train planetary-24-18-60 --planets three | --planets:
teeth train planetary-24-18-60 --planets 3,4 | --planets:
teeth train planetary-24-18-60 --clearance much | --clearance:
teeth train planetary-24-18-60 --max-radius '20 deg' | --max-radius:
teeth train planetary-24-18-60 --planets three --clearance much | --planets: | --clearance:

# reconstruct
reconstruct back-train --same E4=e3 | give --rank too
reconstruct back-train --rank price-1974 --same E4 | such as E4=e3
reconstruct back-train --rank price-1974 --same E44=e3 | 'E44' is not a wheel or an output
reconstruct back-train --rank vitruvius-hodometer | no wheel of 'b'
reconstruct front-inferior-planets --rank freeth-2021 | cannot be ranked if arbors turn on a carrier

# dynamics
dynamics pin.yaml | no input speed is declared
dynamics moon-triangular --rate 0.3 --turns 1 | sun | c | d | moon | declare `inertia:
dynamics pin.yaml --rate 0.3 --turns 1 --skip 0 --steps 1000 --no-fast --rate 0 | --rate
dynamics pin.yaml --rate 0.3 --turns 1 --skip 0 --steps 1000 --no-fast --turns 0 | turns must be above 0
dynamics pin.yaml --rate 0.3 --turns 1 --skip 0 --steps 1000 --no-fast --turns x | number of turns
dynamics pin.yaml --rate 0.3 --turns 1 --skip 0 --steps 1000 --no-fast --restitution 1.5 | from 0 to 1
dynamics pin.yaml --rate 0.3 --turns 1 --skip 0 --steps 1000 --no-fast --of c | 'c'
dynamics pin.yaml --rate 0.3 --turns 1 --skip 0 --steps 1000 --no-fast --state s | s

# sphere
sphere icosidodecaedron | did you mean 'icosidodecahedron'
sphere cube --teeth 5=20 | 5
sphere icosidodecahedron --teeth 5=20,3=12 --plot x.gif | gif
sphere icosidodecahedron --radius 6=1 | use 5, 3
sphere | give a solid

# export
export planetary-24-18-60 | no output file or folder is given
export planetary-24-18-60 --to d -o x.glb | both given
export planetary-24-18-60 -o x.pdf | a train cannot be written as '.pdf'
export planetary-24-18-60 -o x | a train cannot be written as 'x'
export planetary-24-18-60 -o x.glb --wheel s | a wheel cannot be written as '.glb'
export planetary-24-18-60 -o x.svg --wheel nobody | the train has no wheel 'nobody'
export planetary-24-18-60 --to d --as svg,pdf | 'pdf' is not an export format
export planetary-24-18-60 --to d --wheel s | only to one file
export planetary-24-18-60 -o x.glb --turns many | not a valid number of turns
export planetary-24-18-60 -o x.stl --module 0mm | a module of 0 mm
export planetary-24-18-60 -o x.stl --module '1 m' | a module of 1000 mm cannot be made | why:
export planetary-24-18-60 -o x.stl --module '0.01 mm' | a module of 0.01 mm cannot be made | why:
export planetary-24-18-60 --to d --thickness '1.5 m' | a thickness of 1500 mm cannot be made | why:
export planetary-24-18-60 --to d --bore '1.5 m' | a bore of 1500 mm cannot be made | why:
export planetary-24-18-60 --to d --backlash '1.5 m' | a backlash of 1500 mm cannot be made | why:
export planetary-24-18-60 --to d --sheet 1x1km | a side of a sheet of 1e+06 mm cannot be made | why:
export planetary-24-18-60 -o x.stl --thickness two | two
export watch-going-train --to d --as svg --sheet 300 | --sheet
export watch-going-train --to d --as svg --sheet 300x200 | --sheet
export watch-going-train --to d --as svg --sheet ax2mm | --sheet
export watch-going-train --to d --as svg --sheet 300x200x1mm | --sheet

# view
view planetary-24-18-60 -o . | folder | why:
draw planetary-24-18-60 -o . | folder | why:
draw planetary-24-18-60 -o .. | folder | why:
view planetary-24-18-60 -o missing/train.html | missing does not exist | why:
view planetary-24-18-60 -o train.txt | not a suffix of an HTML page | why:
view planetary-24-18-60 -o train.png | pictures and films can be saved from the page | why:
view planetary-24-18-60 -o train | no suffix | why:
view planetary-24-18-60 -o {long}.html | not a valid file name | why:
view worm --embed --kiosk | --embed and --kiosk are given together | why:
view worm planetary --embed | two trains | why:
view worm planetary --kiosk | two trains | why:
view worm --skip 1 | options of --dynamics are given without --dynamics | why:
view worm --turns 2 | options of --dynamics are given without --dynamics | why:
view worm planetary --dynamics | two trains are given with --dynamics | why:

# budget
budget freeth-2008 --of moon --turns 1 --samples 64 --span '0 d' | --span: the value must be greater than 0, not 0 d
budget freeth-2008 --of moon --turns 1 --samples 64 --span '19 furlongs' | --span: '19 furlongs' has an unknown unit
budget freeth-2008 --of moon --turns 1 --samples 64 --turns -1 | 64 positions in -1 turns are out of range
budget freeth-2008 --of moon --turns 1 --samples 64 --cutting 'pitch_deviation=1 %' | 'freeth-2008' has no tooth form for which cutting errors can be computed
budget freeth-2008 --of moon --turns 1 --samples 64 --body moon | --body: 'moon' is not an output with a body
budget freeth-2008 --of moon --turns 1 --samples 64 --body moon=mars | --body: 'moon=mars' is not an output with a body
budget freeth-2008 --of moon --turns 1 --samples 64 --body mon=moon | unknown output 'mon'

# mesh --form triangular
mesh 48 96 --form triangular --objective speed | does not name one objective
mesh 48 96 --form triangular --objective error --free depth | not a free parameter
mesh 48 96 --form triangular --objective error --free window=0.5 | NAME=LOW:HIGH
mesh 48 96 --form triangular --objective error --within depth=1 | NAME=LIMIT
mesh 48 96 --form triangular --objective error --within 'error=1 m' | an angle is required
mesh 48 96 --form triangular --objective error --within stops=5% | needs cutting errors
mesh 48 96 --form triangular --objective error -p clearance_factor=1.01 | cannot be combined with --objective
mesh 48 96 --form triangular --objective error --vary window=0.1:0.9:3 | cannot be combined with --objective
mesh 48 96 --form triangular --objective loss | without friction
mesh 48 96 --form triangular --free radii | give --objective
mesh 48 96 --form triangular --cutting 'pitch_deviation=1 %' | give --objective
mesh 48 96 --form triangular -p window=0.5 -p radii=0 | out of range
mesh --form triangular 2 96 -p clearance_factor=1.01 | at least 3 teeth
mesh --form triangular 48 96 -p clearance_factor=1 | above 1
mesh --form triangular 48 96 -p clearance_factor=nan | 'nan' is not a number
mesh --form triangular 48 96 -p clearance_factor=inf | 'inf' is not a number
mesh --form triangular 48 96 -p excess=0 | above 0
mesh --form triangular 48 96 -p window=1.5 | between 0
mesh --form triangular 48 96 -p clearance_factor=1.01 -p excess=0.01 | exactly one of
mesh --form triangular 48 96 -p clearance_factor=1.01 -p half_angle=95deg | between 0 and 90 deg
mesh --form triangular 48 96 -p clearance_factor=1.01 -p half_angle=30 | has no unit
mesh --form triangular 48 96 -p clearance_factor=1.01 -p half_angle=3mm | is a length
mesh --form triangular 48 96 -p clearance_factor=1.01 --friction -0.1 | 0 or more
mesh --form triangular 48 96 -p clearance_factor=1.01 --rate '3 furlong' | unknown unit
mesh --form triangular 48 96 -p centre_distance=40mm | cannot be related to the size of these wheels
mesh --form triangular 48 96 -p centre_distance=40 -p radii=10mm,20mm | mix numbers without a unit
mesh --form triangular 48 96 -p backlash=9mm --module 0.5mm | no clearance gives a backlash
mesh --form triangular 8 64 -p window=0.5 | no clearance lets wheels of 8 and 64
mesh --form triangular 48 96 --vary clearence_factor=1:2:3 | cannot be varied
mesh --form triangular 48 96 --vary clearance_factor=1:2 | FIRST:LAST:COUNT
mesh --form triangular 48 96 -p clearance_factor=1.01 --plot x.bmp | '.bmp'
mesh --form triangular 48 96 -p clearance_factor=1.01 --profile w.svg | the module is missing
mesh --form triangular 48 96 --module 1mm -p clearance_factor=1.01 --profile w.stl | not an output format
mesh --form triangular 48 96 --profile w.svg --vary clearance_factor=1.01:1.02:3 | omit --profile or --vary
mesh 48 96 --form triangular -p window=0.5 --friction dokos | error: --friction: | give --rate and --module
mesh 48 96 --form triangular -p window=0.5 --friction dokos --rate '1 rpm' | error: --friction: | follows from the module
mesh 48 96 --form triangular -p window=0.5 --friction dokos --module 1mm | error: --friction: | follows from the speed of the driver
mesh 48 96 --form triangular -p window=0.5 --friction stribek,static=1 | error: --friction: | 'stribeck'
mesh 48 96 --form triangular -p window=0.5 --friction stribeck,static=0.2 | error: --friction: | kinetic: Field required
mesh 48 96 --form triangular -p window=0.5 --friction dokos --vary window=0.1:0.9:3 | error: --friction: | needs a coefficient of friction
mesh 48 96 --form triangular -p window=0.5 --friction dokos --objective loss | error: --friction: | needs a coefficient of friction

# mesh
mesh 60 8 --backlash 0.1mm | given as -p backlash=VALUE
mesh --compare 24 36 --form involut | --form | did you mean 'involute'
mesh --compare 24 36 --form rubber | --form | give one or more of: involute
mesh --compare 24 36 --form '' | --form | give one or more of
mesh --compare 24 36 -p pressure_angle=50deg | -p pressure_angle | between 0 and 45 deg
mesh --compare 24 36 -p pressure_angle=20 | -p pressure_angle | has no unit
mesh --compare 24 36 -p arcs=0.5,x | -p arcs | in pitches
mesh --compare 24 36 -p arcs=-1,2 | -p arcs | in pitches
mesh --compare 24 36 -p arcs=0.2,0.2 | -p arcs | the contact ratio 0.4 is below 1
mesh --compare 8 9 | -p arcs | end the approach before 0.463
mesh --compare 2 36 | Z1 Z2 | at least 3 teeth
mesh --compare 36 24 --internal | Z1 Z2 | cannot contain
mesh --compare 24 36 --internal --shaft-angle 90deg | --shaft-angle | parallel
mesh --compare 24 36 --shaft-angle 200deg | Z1 Z2 | between 0 and 180 deg
mesh --compare 24 36 -o x.pdf | -o | .md, .html, .json
mesh 24 36 -p pressure_angle=95deg | -p pressure_angle | between 0 and 90 deg
mesh 24 36 --form uniform_stress -p pressure_angle=45deg | -p pressure_angle | between 0 and 45 deg
mesh 24 36 --form uniform_temperature -p reading=d | -p reading | 'd' is not a valid value
mesh 24 36 --friction -1 | --friction | 0 or more
mesh 24 36 -p centre_distance=20 | Z1 Z2 | too short
mesh 24 36 -p backlash=0.1mm | Z1 Z2 | give the `module` of both wheels
mesh 24 36 --module -2mm | --module | above 0
mesh 24 36 --profile w.svg | --module | to scale
mesh 24 36 --module 2mm --profile w.step | --profile | .svg, .dxf, .csv
mesh 24 36 --module 2mm --profile w.svg --blank fillet=9mm | --blank fillet | at most
mesh 24 36 --module 2mm --profile w.svg --blank bore=43mm | --blank bore | 43 mm
mesh 24 36 --module 2mm --profile w.svg --blank rim=4mm | --blank rim | omit --blank rim
mesh 24 36 --module 2mm --profile w.svg --blank tolerance=0mm | --blank tolerance | above 0
mesh 24 36 --module 2mm --profile /no/where/w.svg | folder /no/where does not exist
mesh 24 36 --shaft-angle 90deg --module 2mm --profile w.svg | --profile | on a sphere
mesh 8 60 --module 2mm --profile w.svg | --profile | addendum of at most
mesh 24 36 --form involut | involut | did you mean 'involute'?
mesh 24 36 -p presure_angle=25deg | -p presure_angle | did you mean 'pressure_angle'?
mesh 24 36 -p shift | -p | KEY=VALUE
mesh 24 36 --form cycloidal --helix 18deg | --helix | does not apply to cycloidal teeth
mesh 24 36 --inertia '1 kg mm2' | --inertia | does not apply to involute teeth
mesh 24 36 --form lantern --form cycloidal | --form | add --compare
mesh | Z1 Z2 | the tooth counts are missing

# others
pin 9mm 9mm | through the slot's axis
pin 1mm 9mm --driver slot | cannot drive
pin -- 9mm -1mm | an offset of 0 or more
pin 9mm 8mm --driver slot --friction 2 | locks
motion moon-triangular --resume --samples 64 | --resume
torques pin.yaml --turns 1 --samples 20 --trials 5 | declares no random friction
solve zf-8hp70 --of OOT | no output or link 'OOT' | did you mean 'OUT'?
solve planetary --state 'ring fixt' | no state 'ring fixt' | did you mean 'ring fixed'?
inspect equations zf-8hp70 --state 9 | no state '9' | 1, 2, 3, 4, 5, 6, 7, 8, R
solve worm --state 1 | no state '1' | omit the state
solve worm --method exakt | 'exakt' | did you mean 'exact'?
inspect graph worm --as dott | 'dott' | did you mean 'dot'?
inspect graph worm -o g.png | '.png' | .md, .dot, .gv, .graphml, .json
report worm -o r.pdf | '.pdf' | .md, .html, .json
compare worm -o r.pdf | '.pdf' | .md, .html, .json
inspect schema --as yaml | 'yaml' | json, markdown, answers
periods month_synodik | no name contains 'month_synodik' | month_synodic
torques pin.yaml -o -.csv | --turns
torques pin.yaml --of a | --turns
torques norton-planetary --turns period | the torque has no period
"""  # noqa: E501
"""Command lines by command, each with texts of its error."""


@pytest.mark.parametrize("line", [line for line in REFUSED.splitlines() if line and not line.startswith("#")])
def test_what_cannot_be_requested_is_refused(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name, text in FILES.items():
        Path(name).write_text(text, encoding="utf-8")
    command, *said = line.format(long="x" * 300).split(" | ")
    done = ended(*shlex.split(command))
    assert (done.returncode, done.stdout) == (2, "")
    error = " ".join(done.stderr.replace("│", " ").split())
    assert all(each.strip() in error for each in (*said, "fix: ")), done.stderr
    assert "Traceback" not in error
    assert {path.name: path.read_text(encoding="utf-8") for path in tmp_path.iterdir()} == FILES
