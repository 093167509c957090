"""All studies, in the order of the report. A new one is its file and a line here."""

from __future__ import annotations

from collections.abc import Callable

from studies.claims import run as claims
from studies.clearance_influence import run as clearance_influence
from studies.clearance_size import run as clearance_size
from studies.common.study import Options
from studies.contact_laws import run as contact_laws
from studies.drive_mode import run as drive_mode
from studies.extremes import run as extremes
from studies.scene_detail import run as scene_detail
from studies.slider_crank import run as slider_crank
from studies.speed_accuracy import run as speed_accuracy
from studies.which_pin import run as which_pin

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
