r"""The force of a clearance pin as function expressions: Eq. 3, 4, 7 and 8 of the paper.

    e = |P_journal - P_bore|,  n = e / |e|,  t = n turned by +90 degrees
    depth  = |e| - c                                                     Eq. 3
    normal = K depth^n (1 + chi rate / w),  chi = 3 (1 - e_r^2) / 4      Eq. 4 (K by Eq. 5 and 6)
    friction = -mu_d c_d normal sign(slip)                               Eq. 7, c_d by Eq. 8

w is the initial impact velocity, at least the law's floor. It has to be remembered: the differential equation

    v' = (rate - v) / T while the journal is free,  v' = 0 in contact

follows the rate until the contact begins, and then holds it. In free flight v comes late by T times the
acceleration: with T = 10 us and weight alone by 0.1 mm/s, a tenth of the floor.
The general force acts at the journal's centre and its reaction at the same place on the bore's body; with the
moment of the friction about the journal's centre that is a force at the point of contact on both.
"""

from dataclasses import dataclass

from studies.adams.statements import Statements, functions, number
from support_exudyn.model.pins import ClearancePin
from user_forces.friction.laws import Ambrosio, Frictionless
from user_forces.normal.power_laws import LankaraniNikravesh
from user_forces.values.value import InputError

FOLLOWING = 1e-5  # T [s]
SMALLEST = 1e-30  # [m], so that nothing is divided by zero


@dataclass(frozen=True)
class PinMarkers:
    """Markers of a clearance pin: of journal and bore, floating on the bore's body, and the ground's axes."""

    journal: int
    bore: int
    floating: int
    axes: int


def check_law(name: str, pin: ClearancePin) -> None:
    """Raise InputError unless the pin's contact is the paper's."""
    normal, friction = pin.contact.normal, pin.contact.friction
    if type(normal) is not LankaraniNikravesh:
        raise InputError(f"pins.{name}.contact.normal = {type(normal).__name__}: allowed: LankaraniNikravesh")
    if type(friction) not in (Ambrosio, Frictionless):
        raise InputError(
            f"pins.{name}.contact.friction = {type(friction).__name__}: allowed: Ambrosio, or none"
        )


def write_clearance(out: Statements, name: str, pin: ClearancePin, at: PinMarkers) -> dict[str, str]:
    """Write variables, memory and force of a clearance pin.

    Returns its channels, without the pin's name, each with the expression that is its value.
    """
    bearing, normal, axes = pin.contact.bearing, pin.contact.normal, at.axes
    assert isinstance(normal, LankaraniNikravesh)

    def variable(what: str, expression: str) -> str:
        return f"VARVAL({out.add('VARIABLE', f'{name}_{what}', f'FUNCTION = {expression}')})"

    pair = f"{at.journal},{at.bore},{axes}"
    x, y = variable("x", f"DX({pair})"), variable("y", f"DY({pair})")
    vx, vy = variable("vx", f"VX({pair})"), variable("vy", f"VY({pair})")
    apart = variable("apart", f"MAX(SQRT({x}**2+{y}**2),{number(SMALLEST)})")
    nx, ny = variable("nx", f"{x}/{apart}"), variable("ny", f"{y}/{apart}")
    depth = variable("depth", f"{apart}-{number(bearing.clearance)}")
    rate = variable("rate", f"{nx}*{vx}+{ny}*{vy}")
    journal_arm = variable("journal_arm", f"{number(bearing.journal_radius)}-0.5*{depth}")
    bore_arm = variable("bore_arm", f"{number(bearing.bore_radius)}+0.5*{depth}")
    turning = variable("turning", f"WZ({at.journal})*{journal_arm}-WZ({at.bore})*{bore_arm}")
    slip = variable("slip", f"{nx}*{vy}-{ny}*{vx}+{turning}")
    memory = _impact_velocity(out, name, depth, rate)
    speed = variable("w", f"MAX({memory},{number(normal.rest_velocity)})")
    elastic = variable("elastic", f"{number(normal.stiffness)}*MAX({depth},0)**{number(normal.exponent)}")
    damping = variable("damping", f"1+{number(normal.damping_factor)}*{rate}/{speed}")
    force = variable("normal", f"MAX({elastic}*{damping},0)")
    friction = _friction(out, name, pin, slip, force)
    force_x = variable("force_x", f"-{force}*{nx}-{friction}*{ny}")
    force_y = variable("force_y", f"-{force}*{ny}+{friction}*{nx}")
    on_journal = functions(FX=force_x, FY=force_y, FZ="0", TX="0", TY="0", TZ=f"{journal_arm}*{friction}")
    places = (f"I = {at.journal}", f"JFLOAT = {at.floating}", f"RM = {axes}")
    out.add("GFORCE", name, *places, *on_journal)
    sign = "" if pin.bore == "first" else "-"  # of the first body on the second
    return {
        "force_x": f"{sign}{force_x}",
        "force_y": f"{sign}{force_y}",
        "normal_force": force,
        "friction_force": friction,
        "depth": depth,
        "eccentricity_x": x,
        "eccentricity_y": y,
    }


def _impact_velocity(out: Statements, name: str, depth: str, rate: str) -> str:
    """The memory of the rate at the onset."""
    number_of_next = out.following("DIFF")
    own = f"DIF({number_of_next})"
    follows = f"({rate}-{own})/{number(FOLLOWING)}"
    out.add("DIFF", f"{name}_impact_velocity", "IC = 0", f"FUNCTION = IF({depth}:{follows},0,0)")
    return own


def _friction(out: Statements, name: str, pin: ClearancePin, slip: str, force: str) -> str:
    """The friction force along t on the journal."""
    law = pin.contact.friction
    if not isinstance(law, Ambrosio):
        return f"VARVAL({out.add('VARIABLE', f'{name}_friction', 'FUNCTION = 0')})"
    width = number(law.dynamic_speed - law.static_speed)
    ramp = f"(ABS({slip})-{number(law.static_speed)})/{width}"
    share = f"VARVAL({out.add('VARIABLE', f'{name}_c_d', f'FUNCTION = MIN(1,MAX(0,{ramp}))')})"
    opposed = f"-{number(law.sliding_coefficient)}*{share}*{force}*SIGN(1,{slip})"
    return f"VARVAL({out.add('VARIABLE', f'{name}_friction', f'FUNCTION = {opposed}')})"
