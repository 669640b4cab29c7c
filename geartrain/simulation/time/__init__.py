"""Motion of a train in time (docs/dynamics.md, 4 to 7).

train_in_time         the questions: a run, modes of vibration, separation by steps
time_study            two runs of steps h and h/2, and their comparison
run_figures           the figures of one run, with intervals by batch means, and spectra under a Hann window
time_run              the results
stepped_separation    the rate at which teeth first part, by bisection over runs
stepwise_simulation   a simulation that is advanced step by step
time_report           the report, and its data as JSON; `time_run_plot`, the plot; `verb`, the command
"""
