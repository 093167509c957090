"""What the study of contact laws runs: free impacts and rises under every law."""

from dataclasses import replace

import numpy as np

import user_forces as forces
from studies.common import paper_machine
from studies.contact_laws import catalogue
from studies.contact_laws.catalogue import CYLINDER_LAWS, POWER_LAWS
from studies.contact_laws.free_impact import BORE_MASS, JOURNAL_MASS, one_dimensional_restitution
from support_exudyn import ClearancePin, Scenario, SolverSettings

ASKED = tuple(n / 20 for n in range(1, 20))  # e = 0.05, 0.1 ... 0.95
FEW = (0.1, 0.3, 0.5, 0.7, 0.9)  # for laws whose damping factor is another's
QUICK_ASKED = (0.1, 0.5, 0.9)  # of all laws in the quick form
SPEED = 0.2  # of free impacts [m/s]
# of the coarsest of the three runs of a case; the quick form has fewer cases, and in a rise coarser impacts
IMPACT_STEPS = 96  # of a free impact: where a force jumps at the impact, fewer tell no error
RISE_IMPACT_STEPS = {False: 32, True: 16}  # of an impact in a rise, by whether the form is the quick one
RISE_STEP = 2e-3  # of a rise between impacts, and time between records: twice that is off by 1 N [s]
LOOP_RESTITUTION = 0.5
CLEARANCE_MM = 1.5
RESTITUTION = paper_machine.RESTITUTION
FRICTION = paper_machine.SLIDING_COEFFICIENT
WITH_CLEARANCE = paper_machine.CLEARANCE_PIN
QUICK_RISE = ("exact", "lankarani_nikravesh", "anagnostopoulos", "friction ambrosio")
TEXTBOOK = {
    "lankarani_nikravesh, last impact, floor 1 mm/s": 1e-3,
    "lankarani_nikravesh, last impact, floor 100 mm/s": 0.1,
}
REDUCED_MASS = BORE_MASS * JOURNAL_MASS / (BORE_MASS + JOURNAL_MASS)  # of free impacts [kg]
STIFFNESS = 1e8  # K of free impacts [N/m^1.5], or [N/m] of linear laws


def impact_laws(quick: bool) -> dict[str, tuple[forces.NormalLaw, float]]:
    """Laws of the free impacts and the restitution that is to come out, by case."""
    cases: dict[str, tuple[forces.NormalLaw, float]] = {}
    for name, law in POWER_LAWS.items():
        for asked in QUICK_ASKED if quick else ASKED:
            chosen = law(stiffness=STIFFNESS, restitution=asked)
            cases[f"{name} e={asked:g}"] = (chosen, chosen.delivered_restitution)
    for asked in QUICK_ASKED if quick else FEW:
        linear = forces.Anagnostopoulos(stiffness=STIFFNESS, restitution=asked)
        cases[f"anagnostopoulos e={asked:g}"] = (linear, linear.delivered_restitution)
        bearing = paper_machine.bearing(CLEARANCE_MM)
        for name in CYLINDER_LAWS:
            line = catalogue.cylinder_law(name, bearing, asked)
            cases[f"{name} e={asked:g}"] = (line, line.delivered_restitution)
    cases["hertz e=1"] = (forces.Hertz(stiffness=STIFFNESS), 1.0)
    for ratio in (0.05, 0.2, 0.5, 1.0):
        dashpot = forces.KelvinVoigt(
            stiffness=STIFFNESS, damping=float(2.0 * ratio * np.sqrt(STIFFNESS * REDUCED_MASS))
        )
        cases[f"kelvin_voigt zeta={ratio:g}"] = (dashpot, dashpot.delivered_restitution(REDUCED_MASS))
    for depth in (1e-3, 1e-4):
        impact = forces.AdamsImpact(stiffness=STIFFNESS, full_damping=500.0, full_damping_depth=depth)
        cases[f"adams_impact d_max={1e3 * depth:g} mm"] = (
            impact,
            one_dimensional_restitution(impact, REDUCED_MASS, SPEED),
        )
    return cases


def loop_laws() -> dict[str, forces.NormalLaw]:
    """Laws whose loops of force over depth are drawn, by name."""
    laws: dict[str, forces.NormalLaw] = {
        name: law(stiffness=STIFFNESS, restitution=LOOP_RESTITUTION) for name, law in POWER_LAWS.items()
    }
    laws["kelvin_voigt"] = forces.KelvinVoigt(stiffness=STIFFNESS, damping=5e3)
    laws["anagnostopoulos"] = forces.Anagnostopoulos(stiffness=STIFFNESS, restitution=LOOP_RESTITUTION)
    laws["adams_impact"] = forces.AdamsImpact(stiffness=STIFFNESS, full_damping=2e3, full_damping_depth=3e-4)
    bearing = paper_machine.bearing(CLEARANCE_MM)
    laws["johnson"] = catalogue.cylinder_law("johnson", bearing, LOOP_RESTITUTION)
    return laws


def rises(quick: bool) -> dict[str, Scenario]:
    """The rise under every law, by case."""
    friction = catalogue.friction_laws(FRICTION)
    stiffness = paper_machine.stiffness(CLEARANCE_MM)
    laws: dict[str, tuple[forces.NormalLaw, forces.FrictionLaw]] = {
        name: (law, forces.Frictionless())
        for name, law in catalogue.normal_laws(CLEARANCE_MM, RESTITUTION).items()
    }
    exact = forces.Exact(stiffness=stiffness, restitution=RESTITUTION)
    laws |= {f"friction {name}": (exact, law) for name, law in friction.items()}
    if quick:
        laws = {name: laws[name] for name in QUICK_RISE}
    for name, floor in TEXTBOOK.items():
        speed = forces.ImpactVelocity(floor=floor)
        law = forces.LankaraniNikravesh(stiffness=stiffness, restitution=RESTITUTION, damping_speed=speed)
        laws[name] = (law, forces.Frictionless())
    base = replace(paper_machine.ideal_rise(RISE_STEP), record_period=RISE_STEP)
    # of Newton's iterations a looser tolerance spares one a step; it changes means and spreads by 1e-6
    settings = SolverSettings(impact_steps=RISE_IMPACT_STEPS[quick], newton_tolerance=1e-6, backend="symbolic")
    bearing = paper_machine.bearing(CLEARANCE_MM)
    return {
        name: replace(
            base,
            pins={
                WITH_CLEARANCE: ClearancePin(
                    contact=forces.JournalContact(bearing=bearing, normal=normal, friction=tangential)
                )
            },
            solver=settings,
        )
        for name, (normal, tangential) in laws.items()
    }
