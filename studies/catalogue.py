"""All studies, in the order of the report. A new one is its folder and a line here."""

from studies.blow import run as blow
from studies.claims import run as claims
from studies.clearance_influence import run as clearance_influence
from studies.clearance_size import run as clearance_size
from studies.common.study import Study
from studies.contact_laws import run as contact_laws
from studies.drive_mode import run as drive_mode
from studies.extremes import run as extremes
from studies.outside import run as outside
from studies.scene_detail import run as scene_detail
from studies.slack_stiffness import run as slack_stiffness
from studies.slider_crank import run as slider_crank
from studies.speed_accuracy import run as speed_accuracy
from studies.stability import run as stability
from studies.valve_modes import run as valve_modes
from studies.which_pin import run as which_pin

_IN_ORDER = (
    clearance_influence, clearance_size, drive_mode, valve_modes, claims, which_pin, scene_detail, contact_laws,
    slider_crank, outside, stability, blow, slack_stiffness, speed_accuracy, extremes,
)  # fmt: skip
STUDIES: dict[str, Study] = {module.study.name: module.study for module in _IN_ORDER}
DEFAULT = ("clearance_influence", "clearance_size", "drive_mode", "claims")  # the answer to the paper
