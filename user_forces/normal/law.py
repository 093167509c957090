"""What a normal contact law is."""

from __future__ import annotations

from abc import ABC, abstractmethod

from user_forces.values import Value


class NormalLaw(Value, ABC):
    """Normal contact force as a function of depth, its rate and the speed of approach.

    The contract:
    1. `law(depth, rate, approach_speed)` is called with depth > 0 only, all in SI.
    2. `approach_speed` is the rate at the instant of zero depth of the contact that is going on; it
       stays the same until the surfaces part. The law owns no memory: who calls it keeps that number.
    3. The result may be negative (tension). The caller cuts it at zero and counts that it did.
    4. `elastic_force` and `elastic_energy` are the part that is given back; the rest is dissipated.
    """

    @abstractmethod
    def __call__(self, depth: float, rate: float, approach_speed: float) -> float:
        """Normal force [N], positive pushes apart."""

    @abstractmethod
    def elastic_force(self, depth: float) -> float:
        """Force [N] at rest at this depth [m] > 0."""

    @abstractmethod
    def elastic_energy(self, depth: float) -> float:
        """Energy [J] stored at this depth [m] > 0."""

    @abstractmethod
    def resting_depth(self, force: float) -> float:
        """Depth [m] at which a constant force [N] >= 0 is held at rest."""
