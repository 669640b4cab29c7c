"""Time-domain simulation of a train (docs/dynamics.md, 4 to 6).

train_in_time         entry points: comparison of two runs with time steps h and h/2, and modes of vibration
run_figures           results of one run, with confidence intervals by batch means, and spectra under a Hann window
time_run              classes of the results
stepwise_simulation   a simulation that is advanced step by step
time_report           the report and its data in JSON format; `time_run_plot` is the plot, `verb` the command
"""
