"""A hydraulic cylinder in the engine: its actuator, whose pressures are coordinates of first order.

The engine weighs residuals of all equations together, in N and in Pa/s: in Pa those of the pressures would
decide alone. They are in MPa here, which the actuator allows: with pressures p/P, areas and volumes P A, P V,
modulus B/P and flow factor P^1.5 its equations stay what they are.

It integrates pressures by the trapezoidal rule, from the rates at the end of the last step. It does not know
those at the start, nor that they jump where a valve opens at once: they are told here, else the first step
after would be of first order.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import (
    NodeGenericODE1,
    ObjectConnectorHydraulicActuatorSimple,
    ObjectConnectorSpringDamper,
)

from support_exudyn.mechanics.cylinder_chambers import PreloadedCylinder
from support_exudyn.model.hydraulic_cylinder import ClosedInlet

UNIT = 1e6  # of pressures in the engine [Pa]
CURRENT = exudyn.ConfigurationType.Current
INITIAL = exudyn.ConfigurationType.Initial


class CylinderItem:
    """A cylinder in the engine.

    Arguments:
        mbs: the engine's system.
        filled: what it is.
        markers: of foot and head.
        settles: whether it has to be able to take part in a search for static equilibrium.
    """

    def __init__(
        self, mbs: Any, preloaded: PreloadedCylinder, markers: list[Any], is_in_equilibrium: bool
    ) -> None:
        model, actuator = preloaded.model, preloaded.actuator
        self.preloaded = preloaded
        self.opening = 0.0
        self._mbs, self._data, self._markers = mbs, mbs.systemData, markers
        self.node = mbs.AddNode(
            NodeGenericODE1(
                referenceCoordinates=[0.0, 0.0],
                initialCoordinates=[p / UNIT for p in preloaded.start_pressures],
                numberOfODE1Coordinates=2,
            )
        )
        self.object = mbs.AddObject(
            ObjectConnectorHydraulicActuatorSimple(
                markerNumbers=markers,
                nodeNumbers=[self.node],
                offsetLength=actuator.start_length - model.oil_length,
                strokeLength=model.oil_length + model.rod_side_length,
                chamberCrossSection0=model.bore_area * UNIT,
                chamberCrossSection1=model.rod_side_area * UNIT,
                hoseVolume0=model.hose_volume * UNIT,
                hoseVolume1=model.rod_side_hose_volume * UNIT,
                actuatorDamping=model.damping,
                oilBulkModulus=model.bulk_modulus / UNIT,
                nominalFlow=model.flow_factor * UNIT**1.5,
                systemPressure=model.system_pressure / UNIT,
                tankPressure=model.tank_pressure / UNIT,
                useChamberVolumeChange=True,
            )
        )
        # while a static equilibrium is looked for, the closed oil is a spring
        self._spring: Any = None
        if is_in_equilibrium:
            spring = ObjectConnectorSpringDamper(markerNumbers=markers, activeConnector=False)
            self._spring = mbs.AddObject(spring)
        self.first = -1

    def assembled(self) -> None:
        """The system is whole: where are the pressures among its coordinates?"""
        self.first = int(self._mbs.systemData.GetNodeLTGODE1(self.node)[0])
        self.tell_rates(INITIAL)

    @property
    def moves(self) -> bool:
        """Whether its valve has to be followed: any that may open, for an inlet need not have breaks."""
        return not isinstance(self.preloaded.model.inlet, ClosedInlet)

    def open_to(self, t: float) -> None:
        """Let the valve be as it is at time t [s]."""
        self._set(self.preloaded.model.inlet.opening(t))

    def switch(self, t: float) -> None:
        """Let the valve be as it is just after a break t [s]."""
        inlet = self.preloaded.model.inlet
        self._set(inlet.opening(t) + inlet.opening_jump(t))

    def _set(self, opening: float) -> None:
        if opening != self.opening:
            self.opening = opening
            self._mbs.SetObjectParameter(self.object, "valveOpening0", opening)
            self._mbs.SetObjectParameter(self.object, "valveOpening1", -opening)

    def motion(self, state: Any = CURRENT) -> tuple[float, float]:
        """Length [m] and its rate [m/s]."""
        output = exudyn.OutputVariableType

        def apart(what: Any) -> Any:
            foot, head = (self._mbs.GetMarkerOutput(marker, what, state) for marker in self._markers)
            return head - foot

        between = apart(output.Position)
        length = float(np.sqrt(between @ between))
        return length, float(between @ apart(output.Velocity)) / length

    def pressures(self, state: Any = CURRENT) -> tuple[float, float]:
        """The pressures of piston side and rod side [Pa]."""
        piston, rod = self._data.GetODE1Coordinates(state)[self.first : self.first + 2].tolist()
        return UNIT * piston, UNIT * rod

    def tell_rates(self, state: Any = CURRENT) -> None:
        """Give the engine the pressures' rates that belong to the state and the valve."""
        rates = self._data.GetODE1Coordinates_t(state)
        own = self.preloaded.pressure_rates(*self.motion(state), self.pressures(state), self.opening)
        rates[self.first : self.first + 2] = [rate / UNIT for rate in own]
        self._data.SetODE1Coordinates_t(rates, state)

    def powers(self) -> tuple[float, float]:
        """Power of pump and tank, and what valve and seals dissipate, now [W]."""
        return self.preloaded.powers(self.motion()[1], self.pressures(), self.opening)

    @contextmanager
    def settling(self) -> Iterator[None]:
        """Let closed oil hold the actuator inside, and give it at the end the pressures that it then has."""
        put = self._mbs.SetObjectParameter
        put(self.object, "activeConnector", False)
        put(self._spring, "activeConnector", True)
        try:
            self.follow()
            yield
        finally:
            put(self.object, "activeConnector", True)
            put(self._spring, "activeConnector", False)
        pressures = self._data.GetODE1Coordinates(INITIAL)
        found = self.preloaded.closed_pressures(self.motion(INITIAL)[0])
        pressures[self.first : self.first + 2] = [p / UNIT for p in found]
        self._data.SetODE1Coordinates(pressures, INITIAL)
        self.tell_rates(INITIAL)

    def follow(self) -> None:
        """Give the spring the stiffness and the force of the closed oil at the initial length."""
        model, length = self.preloaded.model, self.motion(INITIAL)[0]
        stiffness = model.stiffness(length - self.preloaded.actuator.start_length)
        force = model.force(*self.preloaded.closed_pressures(length), 0.0)
        self._mbs.SetObjectParameter(self._spring, "stiffness", stiffness)
        self._mbs.SetObjectParameter(self._spring, "referenceLength", length + force / stiffness)
