"""Force and power of an oil column, from its length; see `columns.OilColumn`."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from support_exudyn.scene_items import OilColumnItem

Series = npt.NDArray[np.float64]


def oil_force(
    item: OilColumnItem, length: Series, rate: Series, extension: Series, speed: Series
) -> tuple[Series, Series]:
    """Force that pushes the ends apart [N], and the energy stored in the oil [J], shape (n,).

    Arguments:
        item: the column.
        length, rate: of the column [m], [m/s].
        extension, speed: of the drive [m], [m/s].
    """
    stiffness = np.array([item.model.stiffness(float(e)) for e in extension])
    natural = np.array([item.natural_length(float(e)) for e in extension])
    compression = natural - length
    force = stiffness * (compression + item.model.damping_time * (speed - rate))
    return force, 0.5 * stiffness * compression**2


def oil_powers(
    item: OilColumnItem, length: float, rate: float, extension: float, speed: float
) -> tuple[float, float]:
    """Power of the drive that lets oil in, and of the damping [W].

        drive = F speed + (dk/dextension) speed u^2 / 2,   damping = k T (du/dt)^2

    The second term of the drive is what the oil gives back because there is more of it to be compressed.
    """
    model = item.model
    stiffness = model.stiffness(extension)
    compression = item.natural_length(extension) - length
    closing = speed - rate
    force = stiffness * (compression + model.damping_time * closing)
    drive = force * speed + 0.5 * model.stiffness_slope(extension) * speed * compression**2
    return drive, stiffness * model.damping_time * closing**2
