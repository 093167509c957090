"""The paper's case: the reference support with a rear-link clearance pin, and what the paper prints of it."""

from dataclasses import replace
from typing import Any

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    HydraulicCylinder,
    HydraulicSupport,
    Inlet,
    Line,
    OilColumn,
    RampedOpening,
    Scenario,
    SolverSettings,
    SuddenOpening,
    bore_area,
    reference_support,
)
from support_exudyn.model.machine import contact_length, links_stiffness
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    Ambrosio,
    Exact,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    NormalLaw,
    PinInBore,
    effective_modulus,
    external_contact_stiffness,
    internal_contact_stiffness,
)
from user_forces.backing import in_series, pin_stiffness
from user_forces.values.value import InputError

CLEARANCE_PIN = "rear_base"
BORE_RADIUS = 0.0655  # [m], implied by Table 2
PAPER, INTERNAL, CYLINDERS = CONTACTS = ("paper", "internal", "cylinders")  # of pin and bore
HERTZ = {PAPER: external_contact_stiffness, INTERNAL: internal_contact_stiffness}
CONTACT_TITLES = {  # for readers
    PAPER: "Eq. 5, two spheres", INTERNAL: "sphere in a hollow sphere", CYLINDERS: "along the pin's length",
}  # fmt: skip
RESTITUTION = 0.9  # assumed; the paper gives none
SLIDING_COEFFICIENT = 0.25  # assumed: dry steel on steel
# oil of the columns, assumed: four columns of 250 mm bore (380 mm of the ZF18000 times 0.65), two to a pair;
# an emulsion of oil in water with the air and the hoses that come with it, 1.5 GPa; by the published vertical
# stiffness of four shields it would be 1.96 GPa
OIL_BORE, OIL_LENGTH, BULK_MODULUS = 0.25, 0.5, 1.5e9  # [m], [m] at the start of the rise, [Pa]
# each pair is fed by two hoses of 25 mm and 10 m, assumed: 10 l; with their fittings and valve block they take
# 1 MPa at 200 l/min
HOSES = Line(volume=10e-3, nominal_flow=200e-3 / 60.0, nominal_drop=1e6)
# jack of the tail beam as a closed cushion of oil, assumed: one cylinder
JACK = OilColumn(bore_area=bore_area(0.14), oil_length=0.3, bulk_modulus=BULK_MODULUS)
# the same columns as hydraulic cylinders, assumed. Pump of 31.5 MPa, as stations for supports are rated. Valve,
# pipe and hoses of a pair let 354 l/min pass at 1 MPa: chosen so that the columns extend by 500 mm from 3 to 5
# s, for which a pair takes 1500 l/min, more than such stations deliver. Seals: 25 kN at 0.25 m/s, 0.8 % of what
# a pair can push
ROD, ROD_SIDE_LENGTH = 0.23, 0.6  # [m], [m] at the start
SYSTEM_PRESSURE, NOMINAL_FLOW, NOMINAL_DROP = 31.5e6, 354e-3 / 60.0, 1e6  # [Pa], [m^3/s], [Pa]
HOSE_VOLUME, SEAL_DAMPING = 5e-3, 1e5  # [m^3] to either side of a pair, [N s/m]
SUDDEN_OPENING, RAMPED_OPENING, RAMP = 0.75, 1.0, 0.5  # of the valve, and [s]
INLETS: dict[str, Inlet] = {
    "mode 1": SuddenOpening(extent=SUDDEN_OPENING),
    "mode 2": RampedOpening(extent=RAMPED_OPENING, ramp=RAMP),
}

ACCURACY = 1e-6  # of the runs that studies make: nothing is left open in what they print
STEP = 1e-3  # [s] of scenarios before an accuracy chooses

PAPERS_LAW = LankaraniNikravesh  # its Eq. 4
SIZES_MM = (0.5, 1.0, 1.5, 2.0)  # the paper's clearances
CLEARANCE_MM = 1.5  # of its section 3
RECORDS = 1e-3  # time between records, by which the fluctuation about the trend is measured [s]

# printed values
STIFFNESS = {0.5: 861300.557, 1.0: 859629.849, 1.5: 857942.947, 2.0: 856239.607}  # Table 2, N/mm^1.5
MEAN_FORCE = {0.5: 51375.609, 1.0: 51491.566, 1.5: 51649.027, 2.0: 51795.195}  # Table 3, N
FORCE_SPREAD = {0.5: 6114.940, 1.0: 5938.103, 1.5: 6013.112, 2.0: 6188.895}  # Table 3, N
MEAN_ACCELERATION = {0.5: 0.0030, 1.0: -0.0515, 1.5: -0.2733, 2.0: -0.3219}  # section 4.1, deg/s^2


def case_name(clearance_mm: float, sliding_coefficient: float) -> str:
    """What studies call a case with clearance."""
    return f"{clearance_mm:.1f} mm, mu_d = {sliding_coefficient:g}"


def ideal_name(sliding_coefficient: float) -> str:
    """What studies call a case with the ideal pin."""
    return f"ideal, mu_d = {sliding_coefficient:g}"


def ideal_of(case: str) -> str:
    """The case with the ideal pin of the same friction, with which a case is compared."""
    return f"ideal,{case.partition(',')[2]}"


def bearing(clearance_mm: float, bore_radius: float = BORE_RADIUS) -> JournalBearing:
    """The rear-link pin with this radial clearance; bore_radius: [m]."""
    return JournalBearing(bore_radius=bore_radius, clearance=clearance_mm / 1e3)


def stiffness(clearance_mm: float, bore_radius: float = BORE_RADIUS) -> float:
    """Eq. 5 for this pin [N/m^1.5]: a bore in steel, a pin of 35CrMo; bore_radius: [m]."""
    return external_contact_stiffness(bearing(clearance_mm, bore_radius), STEEL, STEEL_35CRMO)


def normal_law(
    contact: str,
    bearing: JournalBearing,
    support: HydraulicSupport,
    law: type[Any] = Exact,
    backing: float = 1.0,
    **given: Any,
) -> NormalLaw:
    """The law of the rear-link pin's contact, a bore in steel and a pin of 35CrMo.

    Arguments:
        contact: one of CONTACTS: Eq. 5, a sphere in a hollow sphere, or cylinders as long as the machine's pin.
        bearing: of the pin.
        support: whose pin it is.
        law: of K depth^1.5, whose damping factor cylinders have, too.
        backing: stiffness of pin and link behind cylinders, times estimated.
        given: restitution and rest velocity of the law.
    """
    if contact in HERTZ:
        made: NormalLaw = law(stiffness=HERTZ[contact](bearing, STEEL, STEEL_35CRMO), **given)
        return made
    length = contact_length(support, CLEARANCE_PIN)
    if contact != CYLINDERS or length is None:
        allowed = ", ".join(CONTACTS)
        raise InputError(
            f"contact = {contact!r}: allowed: {allowed}, the last if the machine knows its pin's length"
        )
    estimated = in_series(
        [
            pin_stiffness(bearing.journal_radius, length, STEEL_35CRMO),
            links_stiffness(support, CLEARANCE_PIN, STEEL),
        ]
    )
    return PinInBore(
        bearing=bearing,
        length=length,
        effective_modulus=effective_modulus(STEEL, STEEL_35CRMO),
        backing_stiffness=backing * estimated,
        damping=law.__name__,
        **given,
    )


def clearance_joint(
    clearance_mm: float,
    sliding_coefficient: float,
    bore_radius: float = BORE_RADIUS,
    contact: str = PAPER,
    law: type[Any] = Exact,
) -> ClearancePin:
    """The rear-link pin as a clearance pin; the bore is in the base. bore_radius: [m]; contact: of CONTACTS.

    law: see `normal_law`; studies on the paper take PAPERS_LAW.
    """
    of_pin = bearing(clearance_mm, bore_radius)
    normal = normal_law(
        contact,
        of_pin,
        reference_support(),
        law,
        restitution=RESTITUTION,
    )
    friction = Ambrosio(sliding_coefficient=sliding_coefficient) if sliding_coefficient else Frictionless()
    return ClearancePin(contact=JournalContact(bearing=of_pin, normal=normal, friction=friction))


def ideal_rise(step: float) -> Scenario:
    """The rise of 500 mm from 3 to 5 s with ideal pins, drive mode 2."""
    return Scenario(
        machine=reference_support(), drive=CubicStep(), duration=5.0, step=step, record_period=RECORDS
    )


def clearance_rise(
    clearance_mm: float,
    sliding_coefficient: float,
    step: float,
    impact_steps: int = 512,
    *,
    law: type[Any] = Exact,
) -> Scenario:
    """The rise with clearance in the rear-link pin, its journal concentric at the start.

    law: see `clearance_joint`.
    """
    settings = SolverSettings(impact_steps=impact_steps)
    pins = {CLEARANCE_PIN: clearance_joint(clearance_mm, sliding_coefficient, law=law)}
    return replace(ideal_rise(step), pins=pins, solver=settings)


def oil_columns() -> dict[str, OilColumn]:
    """Both pairs of columns on oil behind hoses, alike."""
    oil = OilColumn(
        bore_area=bore_area(OIL_BORE, 2), oil_length=OIL_LENGTH, bulk_modulus=BULK_MODULUS, line=HOSES
    )
    return {"front_column": oil, "rear_column": oil}


def hydraulic_cylinders(inlet: Inlet) -> dict[str, HydraulicCylinder]:
    """Both pairs of columns as hydraulic cylinders, alike, each with such a valve."""
    cylinder = HydraulicCylinder(
        bore_area=bore_area(OIL_BORE, 2),
        rod_side_area=bore_area(OIL_BORE, 2) - bore_area(ROD, 2),
        oil_length=OIL_LENGTH,
        rod_side_length=ROD_SIDE_LENGTH,
        bulk_modulus=BULK_MODULUS,
        system_pressure=SYSTEM_PRESSURE,
        nominal_flow=NOMINAL_FLOW,
        nominal_drop=NOMINAL_DROP,
        hose_volume=HOSE_VOLUME,
        rod_side_hose_volume=HOSE_VOLUME,
        damping=SEAL_DAMPING,
        inlet=inlet,
    )
    return {"front_column": cylinder, "rear_column": cylinder}


def on_cylinders(rise: Scenario, inlet: Inlet) -> Scenario:
    """The run on hydraulic cylinders, which this inlet moves in place of the drive."""
    return replace(rise, actuators=hydraulic_cylinders(inlet), drive=Held(), drives={})
