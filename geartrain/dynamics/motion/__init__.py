"""Motion with real teeth and pins: errors composed through the whole train."""

from geartrain.dynamics.motion.error_composition import ErrorComposition, ErrorSamples, PairErrorSource
from geartrain.dynamics.motion.error_curve import TransmissionErrorCurve
from geartrain.dynamics.motion.motion_model import Motion
from geartrain.dynamics.motion.motion_problem import MotionProblem, build_motion_problem
from geartrain.dynamics.motion.motion_run import MotionRun
from geartrain.dynamics.motion.order_spectrum import SpectrumLine, find_spectrum
from geartrain.dynamics.motion.run_statistics import RunningStatistics
from geartrain.dynamics.motion.superposition import ErrorEstimates, Superposition, find_estimates
from geartrain.dynamics.motion.tooth_impacts import ToothImpact, find_impacts

__all__ = [
    "ErrorComposition",
    "ErrorEstimates",
    "ErrorSamples",
    "Motion",
    "MotionProblem",
    "MotionRun",
    "PairErrorSource",
    "RunningStatistics",
    "SpectrumLine",
    "Superposition",
    "ToothImpact",
    "TransmissionErrorCurve",
    "build_motion_problem",
    "find_estimates",
    "find_impacts",
    "find_spectrum",
]
