"""All studies, in the order of the report. A new one is its folder and a line here."""

from studies.benchmarking import trade
from studies.blow import run as blow
from studies.claims import run as claims
from studies.clearance import run as clearance
from studies.common.study import Study
from studies.contact_laws import run as contact_laws
from studies.drive_mode import run as drive_mode
from studies.drive_mode import valves as valve_modes
from studies.extremes import run as extremes
from studies.outside import run as outside
from studies.scene_detail import run as scene_detail
from studies.slack_stiffness import run as slack_stiffness
from studies.slider_crank import run as slider_crank
from studies.stability import run as stability
from studies.which_pin import run as which_pin

_IN_ORDER: tuple[type[Study], ...] = (
    clearance.ClearanceInfluence, clearance.ClearanceSize, drive_mode.DriveMode, valve_modes.ValveModes,
    claims.Claims, which_pin.WhichPin, scene_detail.SceneDetailStudy, contact_laws.ContactLaws,
    slider_crank.SliderCrankStudy, outside.Outside, stability.Stability, blow.BlowStudy,
    slack_stiffness.SlackStiffness, trade.SpeedAccuracy, extremes.Extremes,
)  # fmt: skip
STUDIES = {study.name: study for study in _IN_ORDER}
DEFAULT = ("clearance_influence", "clearance_size", "drive_mode", "claims")  # the answer to the paper
