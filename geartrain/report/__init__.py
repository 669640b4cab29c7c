"""From a train's answers to a document, and from a document to Markdown, HTML or a terminal.

In: a train's answers, or what any other room found out. Out: for each kind of result a `..._document`, titled sections
of paragraphs and tables, and its `..._data` for JSON. Import from the module that holds a name: a command brings in the
one page it shows, and not the others.

document                                 sections, tables, pictures: independent of how they are shown
text, html_page                          a document as Markdown, on a terminal, as one page of HTML
train_report, answers, shared_page       a train: structure, speeds, outputs, targets, doubts; the page to share
reconstruction_comparison                 several trains side by side
motion_report, power_report, gear_pairs  what real teeth do to a train; its torques; its pairs
posterior_report, monte_carlo_report     counts in doubt; wheels cut by hand, many times over
pair_page, conjugate_pair_page, tooth_form_comparison   one pair of wheels without a train
tooth_numbers, spherical_report          tooth numbers that were found; gears on a sphere
declaration_reference, json_schema       the keys of a declaration; the shapes of answers as JSON
"""
