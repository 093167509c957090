"""What pushes in a joint: contact and friction laws, and the geometry of a journal in its bore.

Nothing in this package knows a multibody engine. Everything is SI (m, s, kg, N, rad).

- `Material`, `STEEL`, `STEEL_35CRMO`, `effective_modulus`: elastic data.
- `external_contact_stiffness`, `internal_contact_stiffness`: K of the laws K depth^1.5.
- `JournalBearing`: bore, clearance and where the journal touches.
- Normal laws (`NormalLaw`), K depth^n with hysteresis damping: `Exact`, `HuntCrossley`, `HerbertMcWhannell`,
  `LeeWang`, `LankaraniNikravesh`, `Gonthier`, `ZhiyingQishao`, `Flores`, `GharibHurmuzlu`, `HuGuo`,
  `SafaeifarFarshidianfar`, `CarvalhoMartins`; elastic: `Hertz`; with a dashpot: `KelvinVoigt`,
  `Anagnostopoulos`, `AdamsImpact`; line contact of cylinders: `Johnson`, `Radzimovsky`, `Goldsmith`,
  `DubowskyFreudenstein`, `Esdu78035`, `Liu`, `Pereira`.
- What a contact does that does not part: `DepthSpeed` (the default) and `TouchSpeed` (textbook).
- Friction laws (`FrictionLaw`): `Frictionless`, `Ambrosio`, `CubicCoulomb`, `Threlfall`, `BengisuAkay`,
  `Stribeck`, `BrownMcPhee`, `LuGre`.
- `JournalContact`: all of these together, evaluated to a force and the arm it acts on.
"""

from user_forces.contact import ContactForce, JournalContact, SlipHistory
from user_forces.friction.ambrosio import Ambrosio
from user_forces.friction.bengisu_akay import BengisuAkay
from user_forces.friction.brown_mcphee import BrownMcPhee
from user_forces.friction.coulomb import CubicCoulomb
from user_forces.friction.frictionless import Frictionless
from user_forces.friction.law import FrictionLaw
from user_forces.friction.lugre import LuGre
from user_forces.friction.stribeck import Stribeck
from user_forces.friction.threlfall import Threlfall
from user_forces.journal import JournalBearing
from user_forces.materials import STEEL, STEEL_35CRMO, Material, effective_modulus
from user_forces.normal.adams_impact import AdamsImpact
from user_forces.normal.anagnostopoulos import Anagnostopoulos
from user_forces.normal.carvalho_martins import CarvalhoMartins
from user_forces.normal.cylinder import CylinderLaw
from user_forces.normal.damping_speed import DampingSpeed, DepthSpeed, TouchSpeed
from user_forces.normal.dubowsky_freudenstein import DubowskyFreudenstein
from user_forces.normal.esdu_78035 import Esdu78035
from user_forces.normal.exact import Exact
from user_forces.normal.flores import Flores
from user_forces.normal.gharib_hurmuzlu import GharibHurmuzlu
from user_forces.normal.goldsmith import Goldsmith
from user_forces.normal.gonthier import Gonthier
from user_forces.normal.herbert_mcwhannell import HerbertMcWhannell
from user_forces.normal.hertz import Hertz
from user_forces.normal.hu_guo import HuGuo
from user_forces.normal.hunt_crossley import HuntCrossley
from user_forces.normal.hysteresis import Hysteresis, delivered_restitution, exact_damping_factor
from user_forces.normal.johnson import Johnson
from user_forces.normal.kelvin_voigt import KelvinVoigt
from user_forces.normal.lankarani_nikravesh import LankaraniNikravesh
from user_forces.normal.law import LoadError, NormalLaw, Touch
from user_forces.normal.lee_wang import LeeWang
from user_forces.normal.liu import Liu
from user_forces.normal.pereira import Pereira
from user_forces.normal.power_law import PowerLaw
from user_forces.normal.radzimovsky import Radzimovsky
from user_forces.normal.safaeifar_farshidianfar import SafaeifarFarshidianfar
from user_forces.normal.zhiying_qishao import ZhiyingQishao
from user_forces.stiffness import external_contact_stiffness, internal_contact_stiffness
from user_forces.values.value import InputError, Value, value

__all__ = [
    "STEEL",
    "STEEL_35CRMO",
    "AdamsImpact",
    "Ambrosio",
    "Anagnostopoulos",
    "BengisuAkay",
    "BrownMcPhee",
    "CarvalhoMartins",
    "ContactForce",
    "CubicCoulomb",
    "CylinderLaw",
    "DampingSpeed",
    "DepthSpeed",
    "DubowskyFreudenstein",
    "Esdu78035",
    "Exact",
    "Flores",
    "FrictionLaw",
    "Frictionless",
    "GharibHurmuzlu",
    "Goldsmith",
    "Gonthier",
    "HerbertMcWhannell",
    "Hertz",
    "HuGuo",
    "HuntCrossley",
    "Hysteresis",
    "InputError",
    "Johnson",
    "JournalBearing",
    "JournalContact",
    "KelvinVoigt",
    "LankaraniNikravesh",
    "LeeWang",
    "Liu",
    "LoadError",
    "LuGre",
    "Material",
    "NormalLaw",
    "Pereira",
    "PowerLaw",
    "Radzimovsky",
    "SafaeifarFarshidianfar",
    "SlipHistory",
    "Stribeck",
    "Threlfall",
    "Touch",
    "TouchSpeed",
    "Value",
    "ZhiyingQishao",
    "delivered_restitution",
    "effective_modulus",
    "exact_damping_factor",
    "external_contact_stiffness",
    "internal_contact_stiffness",
    "value",
]
