"""The hydraulic support in its two free coordinates: compiled, without the engine, for thousands of runs.

    from support_exudyn.reduced import simulate_reduced

    result = simulate_reduced(scenario)
    result["pin.rear_base.force"]  # newton, at result.time

It covers one scene, see `simulate_reduced`, and is independent of the redundant formulation in everything but
the parameters: posture in closed form, equations of motion by virtual power, an embedded Runge-Kutta method.
"""

from support_exudyn.reduced.result import ReducedResult
from support_exudyn.reduced.simulate import simulate_reduced
from support_exudyn.reduced.warm import warm_up

__all__ = ["ReducedResult", "simulate_reduced", "warm_up"]
