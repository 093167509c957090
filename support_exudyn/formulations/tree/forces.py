"""The generalised forces of a tree and its clearance pins; the engine asks for them at every stage."""

import math
from typing import Any, NamedTuple

import numpy as np

from support_exudyn.formulations.tree.branches import Matrix, Tree
from support_exudyn.formulations.tree.loads import FORCE, TURN, WIDTH, evaluate, push
from support_exudyn.mechanics.contact_state import InverseMass, Onset, PinMemory
from support_exudyn.mechanics.oil_column import PreloadedActuator
from support_exudyn.mechanics.pressed_pins import normal
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.pins import ClearancePin
from support_exudyn.scenario.scenario import Scenario
from user_forces.compilation.flat import asks_for_mass, flat_force
from user_forces.lawful import LawError
from user_forces.normal.law import LoadError
from user_forces.values.value import Vector2


class JournalPlace(NamedTuple):
    """Where a journal's centre is against the bore's, and how it moves; SI, ground's axes."""

    x: float
    y: float
    vx: float
    vy: float
    depth: float
    rate: float


class TreeClearanceJoint:
    """One clearance pin of a tree.

    Arguments:
        pin: bearing, laws, and which body has the bore.
        pair: which pair of points it is, see `loads`.
        links, points, work: arrays of `loads`.
        bore_angle: of the bore's body at the start [rad].
    """

    def __init__(
        self, pin: ClearancePin, pair: int, links: Matrix, points: Matrix, work: Matrix, bore_angle: float
    ) -> None:
        self.contact = pin.contact
        self.clearance = pin.contact.bearing.clearance
        self._law, self._asks_for_mass = flat_force(pin.contact), asks_for_mass(pin.contact)
        self.pair = pair
        self.onsets: list[Onset] = []
        self.calls = self.clamped_steps = 0
        self.clamped = False  # the law asked for tension at the stage evaluated last
        self._arrays = links, points, work
        row = len(links) + 2 * pair
        self._bore, self._journal = work[row, :TURN], work[row + 1, :TURN]  # views: X to SPIN
        bore_link = int(points[2 * pair, 0])
        self._bore_link = None if bore_link < 0 else work[bore_link]
        self._bore_angle = bore_angle
        self._axes = math.cos(bore_angle), math.sin(bore_angle)  # of a bore in the ground
        self.forgets = pin.contact.normal.forgets
        # where a contact is pressed on again something changes
        self.renews = self.forgets or self._asks_for_mass
        self.start = self.end = JournalPlace(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)  # of the step being tried
        self.memory = PinMemory(False, 0.0, 0.0, 0.0)
        self._inverse_mass = self.memory.inverse_mass

    def remember(self, memory: PinMemory) -> None:
        """Go on with another memory."""
        self.memory = memory
        self._inverse_mass = memory.inverse_mass
        self.clamped = False

    def axes(self) -> tuple[float, float]:
        """Cosine and sine of the angle of the bore's body at the stage evaluated last."""
        if self._bore_link is None:
            return self._axes
        angle = self._bore_angle + float(self._bore_link[TURN])
        return math.cos(angle), math.sin(angle)

    def place(self) -> JournalPlace:
        """Where the journal is at the stage evaluated last."""
        bx, by, bvx, bvy, _ = self._bore.tolist()
        jx, jy, jvx, jvy, _ = self._journal.tolist()
        x, y, vx, vy = jx - bx, jy - by, jvx - bvx, jvy - bvy
        eccentricity = math.hypot(x, y)
        # from the middle every way leads outwards
        rate = (x * vx + y * vy) / eccentricity if eccentricity > 0.0 else math.hypot(vx, vy)
        return JournalPlace(x, y, vx, vy, eccentricity - self.clearance, rate)

    def bore_centre(self) -> Vector2:
        """Where the bore's centre is at the stage evaluated last [m]."""
        x, y, *_ = self._bore.tolist()
        return x, y

    def frame(self) -> Matrix:
        """Axes of the bore in columns, in the ground's (2, 2)."""
        c, s = self.axes()
        return np.array([[c, -s], [s, c]])

    def normal(self) -> Matrix | None:
        """Along which the journal is pressed at the stage evaluated last, (2,); None if it is not."""
        place = self.place()
        return normal(place.x, place.y, self.clearance)

    def mass(self, inverse_mass: InverseMass, x: float, y: float) -> float:
        """Mass [kg] that moves with an eccentricity x, y in the ground's axes."""
        c, s = self.axes()
        return inverse_mass.mass(c * x + s * y, c * y - s * x)

    def add_force(self) -> None:
        """Add the force at the stage that was evaluated last, while the surfaces make contact."""
        bx, by, bvx, bvy, bore_spin = self._bore.tolist()
        jx, jy, jvx, jvy, journal_spin = self._journal.tolist()
        x, y = jx - bx, jy - by
        eccentricity = math.hypot(x, y)
        if not eccentricity > self.clearance:
            self.clamped = False
            return
        self.calls += 1
        speed = self.memory.impact_velocity
        mass = self.mass(self._inverse_mass, x, y) if self._asks_for_mass else 1.0
        moving = x, y, jvx - bvx, jvy - bvy, bore_spin, journal_spin
        force = self._law(*moving, 1.0, speed, mass, 0.0, 0.0, 0.0)
        self.clamped = bool(force.clamped)
        arm = force.journal_arm / eccentricity
        at_x, at_y = jx + arm * x, jy + arm * y
        push(*self._arrays, self.pair, at_x, at_y, force.force_x, force.force_y)


class Forces:
    """Forces of clearance pins and columns of oil on the coordinates; gravity is the engine's.

    (Connectors of the engine between markers of a tree do the same, with Python's or symbolic functions, and
    take three times as long: each marker goes through the whole tree again.)

    Arguments:
        tree: the bodies.
        scenario: clearance pins.
        actuators: of oil.
    """

    def __init__(self, tree: Tree, scenario: Scenario, actuators: dict[str, PreloadedActuator]) -> None:
        with_clearance = scenario.clearance_pins
        ends = [_ends(tree, name, with_clearance[name].bore == "first") for name in with_clearance]
        ends += [
            ((c.actuator.foot, c.actuator.foot_point), (c.actuator.head, c.actuator.head_point))
            for c in actuators.values()
        ]
        self.tree = tree
        self.links = _links(tree)
        self.points = _points(tree, [end for pair in ends for end in pair])
        self.actuators = np.array([_actuator(preloaded) for preloaded in actuators.values()]).reshape(-1, 4)
        self.cubic: Matrix = np.zeros((len(actuators), 5))  # of their drives, see `loads`
        self.work: Matrix = np.zeros((len(self.links) + len(self.points), WIDTH))
        arrays = self.links, self.points, self.work
        self.pins = {
            name: TreeClearanceJoint(pin, n, *arrays, _angle(tree, ends[n][0][0]))
            for n, (name, pin) in enumerate(with_clearance.items())
        }
        self.closed: list[tuple[str, TreeClearanceJoint]] = []
        # what a law has raised since this was last set to None
        self.trouble: LoadError | ArithmeticError | None = None
        self.position: list[float] = []  # that were evaluated last: coordinates [rad] and rates [rad/s]
        self.velocity: list[float] = []
        self.evaluations = 0
        self._arrays = self.links, self.points, self.actuators, self.cubic, self.work
        self._force = self.work[: len(self.links), FORCE]

    def __call__(
        self, mbs: Any, t: float, item: int, position: list[float], velocity: list[float]
    ) -> list[float]:
        """Generalised forces [N m] at t [s]; the engine's user function."""
        self.position, self.velocity = position, velocity
        self.evaluations += 1
        name = ""
        evaluate(*self._arrays, t, *position, *velocity)
        try:
            for name, pin in self.closed:  # noqa: B007 - is told if one fails
                pin.add_force()
        except (LoadError, ArithmeticError) as error:  # perhaps only because the step is too long
            if self.trouble is None:  # what follows from it are no numbers
                self.trouble = error.at(name) if isinstance(error, LawError) else error
            return [math.nan] * len(position)
        return self._force.tolist()  # type: ignore[no-any-return]

    def moments(self) -> Matrix:
        """Generalised forces so far [N m], shape (n,)."""
        return self._force.copy()

    def watch(self) -> None:
        """Look anew which pins make contact."""
        self.closed = [(name, pin) for name, pin in self.pins.items() if pin.memory.in_contact]


def _ends(tree: Tree, name: str, bore_first: bool) -> tuple[tuple[str, Vector2], tuple[str, Vector2]]:
    """Body and centre of the bore, then of the journal."""
    place = tree.linkage.pins[name]
    first, second = (place.first, place.first_point), (place.second, place.second_point)
    return (first, second) if bore_first else (second, first)


def _angle(tree: Tree, body: str) -> float:
    """Angle of a body's axes at the start [rad]."""
    return 0.0 if body == GROUND else tree.linkage.bodies[body].angle


def _links(tree: Tree) -> Matrix:
    rows = [(link.carrier, *tree.arm(link.carrier, link.joint)) for link in tree.links]
    return np.array(rows, dtype=np.float64)


def _points(tree: Tree, ends: list[tuple[str, Vector2]]) -> Matrix:
    rows = [(number := tree.number(body), *tree.arm(number, point)) for body, point in ends]
    return np.array(rows, dtype=np.float64).reshape(-1, 3)


def _actuator(preloaded: PreloadedActuator) -> tuple[float, float, float, float]:
    model = preloaded.model
    return (
        model.bulk_modulus * model.bore_area,
        model.oil_length,
        model.damping_time,
        preloaded.natural_length(0.0),
    )
