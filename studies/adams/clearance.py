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

from studies.adams.statements import Statements, functions, number
from support_exudyn.model.pins import ClearancePin
from user_forces.friction.laws import Ambrosio
from user_forces.normal.power_laws import LankaraniNikravesh

FOLLOWING = 1e-5  # T [s]
SMALLEST = 1e-30  # [m], so that nothing is divided by zero


# variables of a pin in their order; braces stand for earlier ones, for markers and for numbers
CONTACT = {
    "x": "DX({pair})",
    "y": "DY({pair})",
    "vx": "VX({pair})",
    "vy": "VY({pair})",
    "apart": "MAX(SQRT({x}**2+{y}**2),{smallest})",
    "nx": "{x}/{apart}",
    "ny": "{y}/{apart}",
    "depth": "{apart}-{clearance}",
    "rate": "{nx}*{vx}+{ny}*{vy}",
    "journal_arm": "{journal_radius}-0.5*{depth}",
    "bore_arm": "{bore_radius}+0.5*{depth}",
    "turning": "WZ({journal})*{journal_arm}-WZ({bore})*{bore_arm}",
    "slip": "{nx}*{vy}-{ny}*{vx}+{turning}",
    "w": "MAX({memory},{rest_velocity})",
    "elastic": "{stiffness}*MAX({depth},0)**{exponent}",
    "damping": "1+{damping_factor}*{rate}/{w}",
    "normal": "MAX({elastic}*{damping},0)",
}
RUBBING = {
    "c_d": "MIN(1,MAX(0,(ABS({slip})-{static_speed})/{width}))",
    "friction": "-{sliding_coefficient}*{c_d}*{normal}*SIGN(1,{slip})",
}
FORCES = {"force_x": "-{normal}*{nx}-{friction}*{ny}", "force_y": "-{normal}*{ny}+{friction}*{nx}"}
FOLLOWS = "IF({depth}:({rate}-{memory})/{following},0,0)"


def write_clearance(
    out: Statements, name: str, pin: ClearancePin, journal: int, bore: int, floating: int, axes: int
) -> None:
    """Write variables, memory and force of a clearance pin, and ask for its channels.

    journal, bore, floating, axes: markers of journal and bore, one that floats on the bore's body, and the
    ground's axes.
    """
    bearing, normal, friction = pin.contact.bearing, pin.contact.normal, pin.contact.friction
    assert isinstance(normal, LankaraniNikravesh)
    values = {
        "smallest": SMALLEST, "following": FOLLOWING, "clearance": bearing.clearance,
        "journal_radius": bearing.journal_radius, "bore_radius": bearing.bore_radius,
        "rest_velocity": normal.rest_velocity, "stiffness": normal.stiffness, "exponent": normal.exponent,
        "damping_factor": normal.damping_factor,
    }  # fmt: skip
    rubbing = {"friction": "0"}
    if isinstance(friction, Ambrosio):
        rubbing = RUBBING
        values |= {
            "static_speed": friction.static_speed,
            "width": friction.dynamic_speed - friction.static_speed,
            "sliding_coefficient": friction.sliding_coefficient,
        }
    names = {key: number(value) for key, value in values.items()}
    names |= {"pair": f"{journal},{bore},{axes}", "journal": str(journal), "bore": str(bore)}
    names["memory"] = f"DIF({out.following('DIFF')})"
    for what, formula in (CONTACT | rubbing | FORCES).items():
        variable = out.add("VARIABLE", f"{name}_{what}", f"FUNCTION = {formula.format(**names)}")
        names[what] = f"VARVAL({variable})"
        if what == "slip":  # the first variable that follows needs the memory
            out.add("DIFF", f"{name}_impact_velocity", "IC = 0", f"FUNCTION = {FOLLOWS.format(**names)}")
    moment = f"{names['journal_arm']}*{names['friction']}"
    on_journal = functions(FX=names["force_x"], FY=names["force_y"], FZ="0", TX="0", TY="0", TZ=moment)
    places = (f"I = {journal}", f"JFLOAT = {floating}", f"RM = {axes}")
    out.add("GFORCE", name, *places, *on_journal)
    sign = "" if pin.bore == "first" else "-"  # of the first body on the second
    out.ask(
        f"pin.{name}",
        force_x=f"{sign}{names['force_x']}",
        force_y=f"{sign}{names['force_y']}",
        normal_force=names["normal"],
        friction_force=names["friction"],
        depth=names["depth"],
        eccentricity_x=names["x"],
        eccentricity_y=names["y"],
    )
