"""What pushes in a joint: contact and friction laws, and the geometry of a journal in its bore.

Nothing in this package knows a multibody engine. Everything is SI (m, s, kg, N, rad).

- `Material`, `STEEL`, `STEEL_35CRMO`: elastic data.
- `external_contact_stiffness`: the stiffness coefficient of the contact.
- `JournalBearing`: bore, clearance and where the journal touches.
- `LankaraniNikravesh`: normal law. `Ambrosio`, `Frictionless`: friction laws.
- `JournalContact`: all of these together, evaluated to a force and the arm it acts on.
"""

from user_forces.contact import ContactForce, JournalContact
from user_forces.friction.ambrosio import Ambrosio
from user_forces.friction.frictionless import Frictionless
from user_forces.friction.law import FrictionLaw
from user_forces.journal import JournalBearing
from user_forces.materials import STEEL, STEEL_35CRMO, Material
from user_forces.normal.lankarani_nikravesh import LankaraniNikravesh
from user_forces.normal.law import NormalLaw
from user_forces.stiffness import external_contact_stiffness
from user_forces.values import InputError, Value, value

__all__ = [
    "STEEL",
    "STEEL_35CRMO",
    "Ambrosio",
    "ContactForce",
    "FrictionLaw",
    "Frictionless",
    "InputError",
    "JournalBearing",
    "JournalContact",
    "LankaraniNikravesh",
    "Material",
    "NormalLaw",
    "Value",
    "external_contact_stiffness",
    "value",
]
