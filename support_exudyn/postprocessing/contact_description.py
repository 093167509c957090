"""The laws of every contact, the restitution that a free impact delivers, and the speed of full friction."""

from support_exudyn.files.own_modules import NotImported
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.slow_slip import FULL
from user_forces.catalogue import title
from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Frictionless
from user_forces.normal.law import NormalLaw


def contact_lines(scenario: Scenario) -> list[str]:
    """A line for each kind of contact, with the joints that have it."""
    joints: dict[str, dict[str, None]] = {}  # names, each once, by what their contact is
    for place in scenario.contact_places.values():
        contact = place.contact
        parts = (_of_normal(contact.normal), _of_friction(contact.friction))
        joints.setdefault("; ".join(filter(None, parts)), {})[place.of] = None
    for name, law in scenario.friction_laws.items():
        joints.setdefault(f"ideal, {_of_friction(law)}", {})[name] = None
    return [f"{', '.join(names)}: {text}" for text, names in joints.items()]


def _of_normal(law: NormalLaw) -> str:
    """Name of a normal law, and what it delivers."""
    damping = getattr(law, "damping", "")
    name = title(type(law)) + (f" ({damping})" if isinstance(damping, str) and damping else "")
    restitution, delivered = getattr(law, "restitution", None), getattr(law, "delivered_restitution", None)
    if delivered is None:
        return f"{name}, whose restitution depends on mass and speed"
    said = f"{name}, restitution {restitution:g} specified, {delivered:.3f} delivered"
    rest = getattr(law, "rest_velocity", None)
    return said if rest is None else f"{said} by free impacts faster than {1e3 * rest:g} mm/s"


def _of_friction(law: FrictionLaw) -> str:
    """Name of a friction law, and from which slip on it is full; empty for none."""
    if isinstance(law, Frictionless):
        return ""
    if isinstance(law, NotImported):
        return f"friction {title(type(law))}"
    if law.has_state:
        return f"friction {title(type(law))}, which can stick"
    return f"friction {title(type(law))}, full above a slip of {1e3 * law.slip_speed(FULL):.3g} mm/s"
