"""A linkage that moves at its start: velocities of all bodies from those of some."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.model.linkage import Linkage
from user_forces.values.value import InputError

AT_ODDS = 1e-9  # of the fastest rate: by more the joints do not allow what is asked for


def set_moving(linkage: Linkage, spins: Mapping[str, float]) -> Linkage:
    """The linkage with the velocities that belong to angular velocities of some bodies [rad/s], by name.

    Pins, guides, gears and driven parts hold; driven parts stand still. What that leaves open moves with the
    least kinetic energy.

    Raises InputError if the joints do not allow these velocities together.
    """
    if not spins:
        return linkage
    kinetics = kinetics_of(linkage)
    still = np.zeros(3 * len(linkage.bodies))
    held = kinetics.rows(still)
    asked = np.array([kinetics.turning(still.size, body) for body in spins])
    rows = np.vstack([held, asked])
    rates = np.concatenate([np.zeros(len(held)), list(spins.values())])
    light = 1.0 / np.sqrt(kinetics.mass() + kinetics.stand_in)
    velocity = light * np.linalg.lstsq(rows * light, rates, rcond=None)[0]
    wrong = np.abs(rows @ velocity - rates).max()
    if wrong > AT_ODDS * np.abs(rates).max():
        said = ", ".join(f"{name} = {spin:.6g} rad/s" for name, spin in spins.items())
        raise InputError(
            f"angular velocities at the start, {said}: the joints do not allow them; allowed: of one body for "
            "each freedom that no drive moves"
        )
    return replace(
        linkage,
        bodies={
            name: replace(body, velocity=tuple(rate[:2].tolist()), spin=float(rate[2]))
            for (name, body), rate in zip(linkage.bodies.items(), velocity.reshape(-1, 3), strict=True)
        },
    )
