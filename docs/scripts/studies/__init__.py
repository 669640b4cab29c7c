"""The measurements behind the pages of accuracy: error against run time, in one run, against named alternatives.

`python docs/scripts/make_..._accuracy.py --measure` runs a study, keeps its records under docs/data/ and writes the
page. The folder docs/scripts/ is then on Python's path, so that makers and tests alike say `from studies.mesh_study
import ...`.
"""
