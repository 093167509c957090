"""The force of a bore on its journal: contact and friction laws, and the geometry they need; see README.md.

Nothing in this package knows a multibody engine. Everything is SI (m, s, kg, N, rad). A law that lies in
`normal` or `friction` is found there by `laws`; it stands here by name for those who check types.
What is named here is imported when it is asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from user_forces.values.places import keep_classes, offered

if TYPE_CHECKING:
    from user_forces.catalogue import laws as laws
    from user_forces.conformal import LineContact as LineContact
    from user_forces.conformal import line_contact as line_contact
    from user_forces.contact import ContactForce as ContactForce
    from user_forces.contact import FaceContact as FaceContact
    from user_forces.contact import JournalContact as JournalContact
    from user_forces.contact import SlipHistory as SlipHistory
    from user_forces.contact import SlotContact as SlotContact
    from user_forces.face import Face as Face
    from user_forces.friction.ambrosio import Ambrosio as Ambrosio
    from user_forces.friction.bengisu_akay import BengisuAkay as BengisuAkay
    from user_forces.friction.brown_mcphee import BrownMcPhee as BrownMcPhee
    from user_forces.friction.cubic_coulomb import CubicCoulomb as CubicCoulomb
    from user_forces.friction.frictionless import Frictionless as Frictionless
    from user_forces.friction.law import FrictionLaw as FrictionLaw
    from user_forces.friction.lugre import LuGre as LuGre
    from user_forces.friction.stribeck import Stribeck as Stribeck
    from user_forces.friction.threlfall import Threlfall as Threlfall
    from user_forces.journal import JournalBearing as JournalBearing
    from user_forces.materials import STEEL as STEEL
    from user_forces.materials import STEEL_35CRMO as STEEL_35CRMO
    from user_forces.materials import Material as Material
    from user_forces.materials import effective_modulus as effective_modulus
    from user_forces.materials import external_contact_stiffness as external_contact_stiffness
    from user_forces.materials import internal_contact_stiffness as internal_contact_stiffness
    from user_forces.normal.adams_impact import AdamsImpact as AdamsImpact
    from user_forces.normal.anagnostopoulos import Anagnostopoulos as Anagnostopoulos
    from user_forces.normal.carvalho_martins import CarvalhoMartins as CarvalhoMartins
    from user_forces.normal.cylinder import CylinderLaw as CylinderLaw
    from user_forces.normal.dubowsky_freudenstein import DubowskyFreudenstein as DubowskyFreudenstein
    from user_forces.normal.esdu_78035 import Esdu78035 as Esdu78035
    from user_forces.normal.exact import Exact as Exact
    from user_forces.normal.flores import Flores as Flores
    from user_forces.normal.gharib_hurmuzlu import GharibHurmuzlu as GharibHurmuzlu
    from user_forces.normal.goldsmith import Goldsmith as Goldsmith
    from user_forces.normal.gonthier import Gonthier as Gonthier
    from user_forces.normal.herbert_mcwhannell import HerbertMcWhannell as HerbertMcWhannell
    from user_forces.normal.hertz import Hertz as Hertz
    from user_forces.normal.hu_guo import HuGuo as HuGuo
    from user_forces.normal.hunt_crossley import HuntCrossley as HuntCrossley
    from user_forces.normal.hysteresis import Hysteresis as Hysteresis
    from user_forces.normal.hysteresis import delivered_restitution as delivered_restitution
    from user_forces.normal.hysteresis import exact_damping_factor as exact_damping_factor
    from user_forces.normal.johnson import Johnson as Johnson
    from user_forces.normal.kelvin_voigt import KelvinVoigt as KelvinVoigt
    from user_forces.normal.lankarani_nikravesh import LankaraniNikravesh as LankaraniNikravesh
    from user_forces.normal.law import LoadError as LoadError
    from user_forces.normal.law import NormalLaw as NormalLaw
    from user_forces.normal.lee_wang import LeeWang as LeeWang
    from user_forces.normal.liu import Liu as Liu
    from user_forces.normal.pereira import Pereira as Pereira
    from user_forces.normal.pin_in_bore import PinInBore as PinInBore
    from user_forces.normal.power_law import PowerLaw as PowerLaw
    from user_forces.normal.radzimovsky import Radzimovsky as Radzimovsky
    from user_forces.normal.safaeifar_farshidianfar import SafaeifarFarshidianfar as SafaeifarFarshidianfar
    from user_forces.normal.zhiying_qishao import ZhiyingQishao as ZhiyingQishao
    from user_forces.slot import Slot as Slot
    from user_forces.values.value import InputError as InputError
    from user_forces.values.value import Value as Value
    from user_forces.values.value import value as value

_PLACES = {
    ".catalogue": ("laws",),
    ".conformal": ("LineContact", "line_contact"),
    ".contact": ("ContactForce", "FaceContact", "JournalContact", "SlipHistory", "SlotContact"),
    ".face": ("Face",),
    ".friction.ambrosio": ("Ambrosio",),
    ".friction.bengisu_akay": ("BengisuAkay",),
    ".friction.brown_mcphee": ("BrownMcPhee",),
    ".friction.cubic_coulomb": ("CubicCoulomb",),
    ".friction.frictionless": ("Frictionless",),
    ".friction.law": ("FrictionLaw",),
    ".friction.lugre": ("LuGre",),
    ".friction.stribeck": ("Stribeck",),
    ".friction.threlfall": ("Threlfall",),
    ".journal": ("JournalBearing",),
    ".materials": (
        "STEEL",
        "STEEL_35CRMO",
        "Material",
        "effective_modulus",
        "external_contact_stiffness",
        "internal_contact_stiffness",
    ),
    ".normal.adams_impact": ("AdamsImpact",),
    ".normal.anagnostopoulos": ("Anagnostopoulos",),
    ".normal.carvalho_martins": ("CarvalhoMartins",),
    ".normal.cylinder": ("CylinderLaw",),
    ".normal.dubowsky_freudenstein": ("DubowskyFreudenstein",),
    ".normal.esdu_78035": ("Esdu78035",),
    ".normal.exact": ("Exact",),
    ".normal.flores": ("Flores",),
    ".normal.gharib_hurmuzlu": ("GharibHurmuzlu",),
    ".normal.goldsmith": ("Goldsmith",),
    ".normal.gonthier": ("Gonthier",),
    ".normal.herbert_mcwhannell": ("HerbertMcWhannell",),
    ".normal.hertz": ("Hertz",),
    ".normal.hu_guo": ("HuGuo",),
    ".normal.hunt_crossley": ("HuntCrossley",),
    ".normal.hysteresis": ("Hysteresis", "delivered_restitution", "exact_damping_factor"),
    ".normal.johnson": ("Johnson",),
    ".normal.kelvin_voigt": ("KelvinVoigt",),
    ".normal.lankarani_nikravesh": ("LankaraniNikravesh",),
    ".normal.law": ("LoadError", "NormalLaw"),
    ".normal.lee_wang": ("LeeWang",),
    ".normal.liu": ("Liu",),
    ".normal.pereira": ("Pereira",),
    ".normal.pin_in_bore": ("PinInBore",),
    ".normal.power_law": ("PowerLaw",),
    ".normal.radzimovsky": ("Radzimovsky",),
    ".normal.safaeifar_farshidianfar": ("SafaeifarFarshidianfar",),
    ".normal.zhiying_qishao": ("ZhiyingQishao",),
    ".slot": ("Slot",),
    ".values.value": ("InputError", "Value", "value"),
}

__getattr__, __dir__ = offered(__name__, _PLACES)
keep_classes(__name__, _PLACES)
