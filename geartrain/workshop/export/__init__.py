"""Files for makers and for other tools: outlines to cut, plates, solids, graphs, tables.

Lengths are in mm, in GLB in m. Only formats are computed here: outlines are those of docs/shapes.md, motions in GLB the
exact speeds.

file_set         the files of an export, and tables as CSV
triangle_files   STL and GLB
step_file        STEP
rexs             REXS
cut_sheets       outlines of wheels and plates, laid out on sheets
parts_list       the parts with their stock and fits
assembly_guide   the README of a folder: assembly in steps, with pictures
proof            proof that the written parts turn
verb             the command
"""
