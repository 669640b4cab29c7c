"""Mean torques: balances of links, the flow of power, verdicts.

load_case                            a train in one case, as torques see it; the check by virtual work
torque_balance, flow_patterns        the balance of every link; the patterns of power flow that agree with its losses
mean_efficiencies                    what each pair loses on the mean, by which of its torques is constant
torque_analysis                      from a declared train to its torques and their verdict
torque_results                       the answer; torques on single links and pairs
power_flow                           the powers of an answer: in a chart, circulating in loops
drivers                              who drives each pair
neglected_effects                    what a balance of means does not count
"""
