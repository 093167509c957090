"""The machine and the pin that a study is about: the paper's, or the user's own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from studies.common import paper_machine
from studies.common.paper_machine import CLEARANCE_MM
from studies.common.rise import PAPER, Watched
from support_exudyn import ClearancePin, CubicStep, IdealPin, Pin, Scenario, SolverSettings
from support_exudyn.commands.command_line import warn
from support_exudyn.files import load_toml, read_scenario_file
from support_exudyn.files.machines.read import load_machine, read_machine
from support_exudyn.files.scenarios.short_joints import ShortPin, pin_in_machine
from support_exudyn.model.linkage import GROUND
from support_exudyn.simulation.automatic_settings import cheapest
from user_forces import Ambrosio, Frictionless
from user_forces.catalogue import title
from user_forces.friction.law import FrictionLaw
from user_forces.values.value import InputError, short


@dataclass(frozen=True)
class Subject:
    """What a study is about.

    motion: the run with an ideal pin. pin: the pin that gets clearance. given: its pin in the user's scenario,
    of which all but the clearance and the friction is kept; None: the paper's contact for the paper's machine,
    else the usual one, in a bore of bore_radius [m]. name: how sentences call the machine; empty for the
    paper's.
    """

    motion: Scenario
    pin: str
    given: ClearancePin | None = None
    bore_radius: float = paper_machine.BORE_RADIUS
    name: str = ""

    @property
    def is_paper(self) -> bool:
        """Whether this is the paper's machine and pin, of which the paper prints numbers."""
        return not self.name

    @cached_property
    def watched(self) -> Watched:
        """Which channels and times are looked at: the pin, the body that it guides, and the motion."""
        if self.is_paper:
            return PAPER
        place, duration = self.motion.unloaded.pins[self.pin], self.motion.duration
        breaks = [t for drive in self.motion.drives_in_use for t in drive.breaks if t <= duration]
        start, end = (min(breaks), max(breaks)) if len(set(breaks)) > 1 else (0.0, duration)
        return Watched(self.pin, place.first if place.second == GROUND else place.second, start, end)

    @property
    def friction(self) -> float:
        """The sliding coefficient of cases with friction; 0 in space, where no ideal pin has any."""
        if self.motion.dimensions == 3:
            return 0.0
        law = self.given.contact.friction if self.given else None
        return float(getattr(law, "sliding_coefficient", paper_machine.SLIDING_COEFFICIENT))

    @property
    def is_slow(self) -> bool:
        """Whether no formulation but the Exudyn one covers the motion with clearance in the pin."""
        share = paper_machine.SIZES_MM[0] / paper_machine.BORE_RADIUS
        size = share * self.bore_radius if self.given is None else 1e3 * self.given.contact.bearing.clearance
        return self.with_clearance(size, self.friction).accuracy != paper_machine.ACCURACY

    def with_clearance(self, clearance_mm: float, sliding_coefficient: float) -> Scenario:
        """The run with this radial clearance in the pin, to the accuracy of studies."""
        return self._with(self.clearance_pin(clearance_mm, sliding_coefficient))

    def ideal(self, sliding_coefficient: float = 0.0) -> Scenario:
        """The run with the pin ideal, with the friction that the pin with clearance has, to that accuracy.

        What clearance does is the difference between the two runs; against an ideal pin without friction the
        difference would contain what friction does, too.
        """
        return self._with(without_clearance(self.clearance_pin(self.clearance_mm, sliding_coefficient)))

    def _with(self, pin: Pin) -> Scenario:
        return to_accuracy(replace(self.motion, pins={**self.motion.pins, self.pin: pin}))

    @property
    def clearance_mm(self) -> float:
        """The radial clearance of the scenario's pin, or the paper's of its section 3 [mm]."""
        given = self.given
        return CLEARANCE_MM if given is None else round(1e3 * given.contact.bearing.clearance, 9)

    @property
    def contact_in_words(self) -> str:
        """The contact that all studies of this machine have in common."""
        contact = self.clearance_pin(self.clearance_mm, self.friction).contact
        length, law = (getattr(contact.normal, name, None) for name in ("length", "damping"))
        touches = "as two spheres" if length is None else f"along its length of {1e3 * length:g} mm"
        known = {
            "restitution": getattr(contact.normal, "restitution", None),
            "friction coefficient": getattr(contact.friction, "sliding_coefficient", None),
        }
        data = "".join(f", {what} {value:g}" for what, value in known.items() if value is not None)
        return (
            f"Pin {self.pin} touches its bore of {1e3 * contact.bearing.bore_radius:g} mm radius {touches} "
            f"({law if isinstance(law, str) else title(type(contact.normal))}{data})."
        )

    def clearance_pin(self, clearance_mm: float, sliding_coefficient: float) -> ClearancePin:
        """The pin with this radial clearance: the same contact in all studies."""
        if self.is_paper:
            law = paper_machine.PAPERS_LAW
            return paper_machine.clearance_joint(clearance_mm, sliding_coefficient, self.bore_radius, law=law)
        if self.given is None:
            short = ShortPin(clearance=clearance_mm / 1e3, friction=sliding_coefficient)
            return pin_in_machine(short, self.motion.machine, self.pin, self.bore_radius)
        contact = self.given.contact.with_clearance(clearance_mm / 1e3)
        return replace(self.given, contact=replace(contact, friction=self._law(sliding_coefficient)))

    def _law(self, sliding_coefficient: float) -> FrictionLaw:
        """The scenario's friction, or Ambrosio's if it has another kind, with this coefficient."""
        if sliding_coefficient == 0.0:
            return Frictionless()
        law = self.given.contact.friction if self.given else None
        own = law if isinstance(law, Ambrosio) else Ambrosio(sliding_coefficient=sliding_coefficient)
        return replace(own, sliding_coefficient=sliding_coefficient)


def without_clearance(pin: ClearancePin) -> IdealPin:
    """The ideal pin with the friction law and the radius of a pin with clearance."""
    law = pin.contact.friction
    if isinstance(law, Frictionless):
        return IdealPin()
    return IdealPin(friction=law, radius=pin.contact.bearing.bore_radius)


def to_accuracy(scenario: Scenario) -> Scenario:
    """The scenario by whatever formulation is cheapest, to an accuracy that leaves nothing open in print.

    What the Exudyn formulation alone covers is computed to a thousandth: a millionth would take hours.
    """
    auto = replace(scenario, formulation="auto", solver=SolverSettings(), accuracy=paper_machine.ACCURACY)
    return replace(auto, accuracy="standard") if cheapest(auto) == "exudyn" else auto


def paper_subject() -> Subject:
    """The reference support and its rear-link pin, as in the paper."""
    return Subject(paper_machine.ideal_rise(paper_machine.STEP), paper_machine.CLEARANCE_PIN)


def chosen_subject(machine: Path | None, pin: str | None) -> Subject:
    """The subject of a command line. Raises InputError or OSError if the machine cannot be read."""
    if machine is None and pin is not None:
        raise InputError(f"--pin {pin}: allowed: together with --machine FILE")
    if machine is None:
        return paper_subject()
    subject = own_subject(machine, pin)
    if subject.is_slow:
        warn(
            f"--machine {machine}: only the Exudyn formulation covers it: minutes, where --list prints seconds"
        )
    return subject


def own_subject(path: Path, pin: str | None = None) -> Subject:
    """The machine of a TOML file: of a machine, which then does the paper's rise, or of a scenario.

    Arguments:
        path: the file, or the name of a machine that comes with the package.
        pin: which pin gets clearance; None: the only one that is not ideal in the scenario, else the paper's.

    Raises InputError that names the file and what is allowed; OSError if it cannot be read.
    """
    shipped = path.suffix.lower() != ".toml" and not path.exists()
    bores: Mapping[str, float]
    if not shipped and "machine" in load_toml(path):
        file = read_scenario_file(path)
        scenario, bores = file.scenario, file.bore_radii
    else:
        data = read_machine(str(path)) if shipped else load_machine(path)
        bores = data.bore_radii
        drive = CubicStep() if data.stroke is None else CubicStep(stroke=data.stroke)
        scenario = Scenario(
            machine=data.machine, drive=drive, duration=5.0, record_period=paper_machine.RECORDS
        )
    pins = tuple(scenario.unloaded.pins)
    loose = [name for name, one in scenario.pins.items() if isinstance(one, ClearancePin)]
    chosen = pin or (loose[0] if len(loose) == 1 else paper_machine.CLEARANCE_PIN)
    if chosen not in pins:
        wrong = f"--pin {short(pin)}: no such pin" if pin else "--pin: missing; it says which pin has clearance"
        raise InputError(f"{path}: {wrong}; allowed: {', '.join(pins)}")
    given = scenario.pins.get(chosen)
    others = {name: one for name, one in scenario.pins.items() if name != chosen}
    clearance = given if isinstance(given, ClearancePin) else None
    if clearance is None and chosen not in bores:
        raise InputError(
            f"{path}: {chosen}: the radius of its bore is missing; allowed: {chosen} = ... below "
            f"[bore_radius_mm] in the machine's file, or clearance in [pins.{chosen}] of a scenario"
        )
    bore = clearance.contact.bearing.bore_radius if clearance else bores[chosen]
    return Subject(replace(scenario, pins=others), chosen, clearance, bore, path.stem.replace("_", " "))
