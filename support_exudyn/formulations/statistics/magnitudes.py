"""Steps divided where a magnitude has a kink: where its vector passes zero, or near to it.

The components of a vector are smooth where its magnitude is not. Over such a step they are the cubics, not the
magnitude, and the pieces of the step become ever shorter towards the place where the vector is shortest.
"""

from collections.abc import Mapping

import numpy as np

from support_exudyn.formulations.statistics.steps import NODES, OF_STEP, POLYNOMIAL
from support_exudyn.mechanics.time_statistics import Series

NEAR = 0.5  # share of the largest magnitude at the nodes of a step: below it, the step is divided
SAMPLES = np.linspace(0.0, 1.0, 17)  # fractions of a step at which the shortest vector is sought
SHORTER = 0.25 ** np.arange(1.0, 6.0)  # lengths of pieces towards the kink
LEAST = 1e-9  # share of a step: shorter pieces are rounding


def divided(
    time: Series, values: Mapping[str, Series], vectors: Mapping[str, Series]
) -> tuple[Series, dict[str, Series]]:
    """Times (steps, 4) [s] and channels (4 steps,) at the nodes of the pieces of all steps.

    Arguments:
        time: of the nodes of each step (steps, 4) [s].
        values: of all channels there (4 steps,).
        vectors: components of the channels that are magnitudes (4 steps, d).
    """
    nodes = {name: vector.reshape(len(time), OF_STEP, -1) for name, vector in vectors.items()}
    kinked = {name: _is_kinked(vector) for name, vector in nodes.items()}
    steps = np.flatnonzero(np.any([*kinked.values()], axis=0)) if kinked else np.zeros(0, int)
    if not steps.size:
        return time, dict(values)
    cuts = [np.where(kinked[name][steps, None], _cuts(vector[steps]), 1.0) for name, vector in nodes.items()]
    edges = np.sort(np.hstack([np.zeros((steps.size, 1)), *cuts, np.ones((steps.size, 1))]))
    there = np.diff(edges) > LEAST
    counts = np.ones(len(time), int)
    counts[steps] = there.sum(axis=1)
    divided_steps = np.zeros(len(time), bool)
    divided_steps[steps] = True
    pieces = np.repeat(divided_steps, counts)
    low, high = edges[:, :-1][there], edges[:, 1:][there]
    powers = (low[:, None] + (high - low)[:, None] * NODES)[..., None] ** np.arange(OF_STEP)

    def within(channel: Series) -> Series:
        """A channel (steps, 4) at the nodes of the pieces of divided steps."""
        coefficients = np.repeat(channel[steps] @ POLYNOMIAL.T, counts[steps], axis=0)
        return np.asarray(np.einsum("pnk,pk->pn", powers, coefficients))

    def at_pieces(channel: Series, inside: Series) -> Series:
        """A channel (steps, 4) at the nodes of all pieces, with its values in divided steps."""
        found = np.repeat(channel, counts, axis=0)
        found[pieces] = inside
        return found

    start, lasting = time[steps, :1], (time[:, -1:] - time[:, :1])[steps]
    inside = (
        np.repeat(start, counts[steps], axis=0) + np.repeat(lasting, counts[steps], axis=0) * powers[..., 1]
    )
    found = {}
    for name, channel in values.items():
        if name in nodes:
            components = [within(component) for component in np.moveaxis(nodes[name], 2, 0)]
            smooth = np.sqrt(np.sum(np.square(components), axis=0))
        else:
            smooth = within(channel.reshape(-1, OF_STEP))
        found[name] = np.ravel(at_pieces(channel.reshape(-1, OF_STEP), smooth))
    return at_pieces(time, inside), found


def _is_kinked(vector: Series) -> Series:
    """Whether a magnitude may have a kink within steps; vector: at their nodes (steps, 4, d)."""
    sizes = np.sqrt(np.sum(vector**2, axis=2))
    near = sizes.min(axis=1) < NEAR * sizes.max(axis=1)
    if vector.shape[2] == 1:  # without a change of sign there is none
        near &= vector.min(axis=(1, 2)) < 0.0
        near &= vector.max(axis=(1, 2)) > 0.0
    return np.asarray(near)


def _cuts(vector: Series) -> Series:
    """Fractions of steps at which pieces end that become shorter towards the shortest vector (steps, cuts).

    vector: at the nodes of the steps (steps, 4, d).
    """
    cubic = np.einsum("xk,kn,snd->sxd", SAMPLES[:, None] ** np.arange(OF_STEP), POLYNOMIAL, vector)
    square = np.sum(cubic**2, axis=2)
    n = np.clip(square.argmin(axis=1), 1, SAMPLES.size - 2)
    rows = np.arange(len(n))
    before, middle, after = square[rows, n - 1], square[rows, n], square[rows, n + 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        aside = 0.5 * (before - after) / (before - 2.0 * middle + after)  # of the parabola through the squares
    at = np.clip(SAMPLES[n] + SAMPLES[1] * np.nan_to_num(aside), 0.0, 1.0)[:, None]
    return np.hstack([at * (1.0 - SHORTER), at, at + (1.0 - at) * SHORTER])
