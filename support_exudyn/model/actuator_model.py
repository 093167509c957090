"""What every model of a linear actuator answers."""

from __future__ import annotations

from abc import ABC

from user_forces.values.value import Value


class ActuatorModel(Value, ABC):
    """How a driven actuator holds its length."""

    def check_extension(self, lowest: float, name: str) -> None:
        """Raise InputError if the actuator cannot be drawn in so far [m]; by default any can."""
        del lowest, name

    def check_elements(self, where: str) -> None:
        """Raise InputError if what it consists of does not go together; by default it does.

        Arguments:
            where: its path in the scenario, `actuators.front_column`.
        """
        del where

    @property
    def hydraulic(self) -> ActuatorModel | None:
        """What holds its length by oil; None if nothing gives."""
        return None
