"""Files for makers and for other tools: outlines to cut, plates, solids, graphs, tables.

Lengths are in mm, in GLB in m. Only formats are computed here: outlines are those of docs/shapes.md, motions in GLB the
exact speeds.

file_set           the files of an export
triangle_files     STL and GLB; `step_file`, `rexs`, `csv_tables`: other formats
cut_sheets         outlines of wheels and plates, laid out on sheets
parts_list, assembly_steps, assembly_pictures, assembly_guide   what to cut and how to assemble it
proof              turns what is written, and proves that it can
"""
