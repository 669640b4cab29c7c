"""What four sources print, and what geartrain gives for it: the rows of docs/sources.md, one module a source.

`python docs/scripts/make_sources.py` works out every row and writes the page; with words after it, it works out and
prints the rows whose place holds them. The folder docs/scripts/ is then on Python's path, as for `studies`.
"""
