"""Motion of a train in time (docs/dynamics.md, 4 to 6).

train_in_time         entry points: a run, modes of vibration
time_study            two runs with time steps h and h/2, and their comparison
run_figures           the figures of one run, with intervals by batch means, and spectra under a Hann window
time_run              the results
stepwise_simulation   a simulation that is advanced step by step
time_report           the report, and its data as JSON; `time_run_plot`, the plot; `verb`, the command
"""
