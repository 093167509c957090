"""Static equilibrium with clearance joints, so that a run can start settled."""

from support_exudyn.formulations.compiled.arrays import Vector
from support_exudyn.formulations.compiled.setup import Model


def settle(model: Model, y: Vector) -> None:
    """Bring the state to rest."""
    raise RuntimeError
