"""The scenes on which speed is set against accuracy."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from studies.common import paper_machine
from studies.slider_crank import run as slider_crank
from support_exudyn import Held, Scenario, SolverSettings

CLEARANCE_MM = 1.5
FRICTION = paper_machine.SLIDING_COEFFICIENT
DROP_TIME = 0.6  # [s]; the journal has come to rest in its bore
REST_VELOCITY = 1e-3  # of the law [m/s], with which the references were computed
RECORD_PERIOD = 1e-3  # [s], of which their means and deviations are


@dataclass(frozen=True)
class BenchmarkScene:
    """A scenario without settings, and what is looked at.

    label: for people. scenario: what is run. pin: the clearance pin. after: from when on its force is
    averaged [s]. step: default of the formulation on the engine [s].
    """

    label: str
    scenario: Scenario
    pin: str
    after: float
    step: float

    @property
    def is_short(self) -> bool:
        """Whether it runs in a second or so, so that every knob can be turned on it."""
        return self.scenario.duration < 1.0


def _support(label: str, scenario: Scenario, after: float) -> BenchmarkScene:
    return BenchmarkScene(label, scenario, paper_machine.CLEARANCE_PIN, after, 5e-4)


def _rise(friction: float) -> Scenario:
    rise = paper_machine.clearance_rise(CLEARANCE_MM, friction, 5e-4, law=paper_machine.PAPERS_LAW)
    pin: Any = rise.pins[paper_machine.CLEARANCE_PIN]
    law = replace(pin.contact.normal, rest_velocity=REST_VELOCITY)
    pins = {paper_machine.CLEARANCE_PIN: replace(pin, contact=replace(pin.contact, normal=law))}
    return replace(rise, pins=pins, record_period=RECORD_PERIOD, solver=SolverSettings())


def _scenes() -> dict[str, BenchmarkScene]:
    smooth, dry = _rise(0.0), _rise(FRICTION)
    crank = slider_crank.scenarios()[slider_crank.SMOOTH]
    half = replace(
        crank,
        duration=0.5 * slider_crank.REVOLUTION,
        record_period=slider_crank.REVOLUTION / 1200,
        solver=SolverSettings(),
    )
    return {
        "drop": _support(
            "drop: held columns, 1.5 mm, no friction", replace(smooth, drive=Held(), duration=DROP_TIME), 0.0
        ),
        "rise": _support("rise: 1.5 mm, no friction", smooth, 3.0),
        "rise, friction": _support("rise: 1.5 mm, friction 0.25", dry, 3.0),
        "rise, oil": _support(
            "rise on oil columns: 1.5 mm, no friction",
            replace(smooth, actuators=paper_machine.oil_columns()),
            3.0,
        ),
        "slider-crank": BenchmarkScene(
            "slider-crank: half a revolution at 5000 rpm", half, slider_crank.PIN, 0.0, 1e-6
        ),
    }


SCENES: Mapping[str, BenchmarkScene] = _scenes()
