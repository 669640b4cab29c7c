"""Export of trains for makers and for other tools: outlines to cut, plates, solids, graphs, tables.

Lengths are in mm (m in GLB). The outlines are described in docs/shapes.md. The motion in GLB uses exact speeds.

file_set         files of an export, and tables as CSV
triangle_files   STL and GLB
step_file        STEP
joint_tree       URDF and MJCF
cut_sheets       outlines of wheels and plates, laid out on sheets
parts_list       list of parts with their stock and fits
assembly_guide   README of a folder: assembly in steps, with pictures
proof            proof that the written parts can turn
verb             the command
"""
