"""All studies, in the order of the report. A new one is its file and a line here."""

from __future__ import annotations

from collections.abc import Callable

from studies import (
    claims,
    clearance_influence,
    clearance_size,
    contact_laws,
    drive_mode,
    extremes,
    scene_detail,
    slider_crank,
    speed_accuracy,
    which_pin,
)
from studies.study import Options

STUDIES: dict[str, Callable[[Options], None]] = {
    clearance_influence.STUDY: clearance_influence.study,
    clearance_size.STUDY: clearance_size.study,
    drive_mode.STUDY: drive_mode.study,
    which_pin.STUDY: which_pin.study,
    scene_detail.STUDY: scene_detail.study,
    claims.STUDY: claims.study,
    contact_laws.STUDY: contact_laws.study,
    slider_crank.STUDY: slider_crank.study,
    speed_accuracy.STUDY: speed_accuracy.study,
    extremes.STUDY: extremes.study,
}
