"""The force of a bore on its journal: contact and friction laws, and the geometry they need; see README.md.

Only `connector` knows Exudyn. Everything is SI (m, s, kg, N, rad). A law that lies in
`normal` or `friction` is found there by `laws`; it stands here by name for those who check types.
What is named here is imported when it is asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from user_forces.values.places import for_types, keep_classes, offered

if TYPE_CHECKING:
    from user_forces.catalogue import laws as laws
    from user_forces.conformal import LineContact as LineContact
    from user_forces.conformal import line_contact as line_contact
    from user_forces.connector.clearance_joint import ClearanceGuide as ClearanceGuide
    from user_forces.connector.clearance_joint import ClearanceJoint as ClearanceJoint
    from user_forces.connector.located import solve_located as solve_located
    from user_forces.contact import ContactForce as ContactForce
    from user_forces.contact import FaceContact as FaceContact
    from user_forces.contact import JournalContact as JournalContact
    from user_forces.contact import SlipHistory as SlipHistory
    from user_forces.contact import SlotContact as SlotContact
    from user_forces.friction.law import FrictionLaw as FrictionLaw
    from user_forces.friction.laws import Ambrosio as Ambrosio
    from user_forces.friction.laws import BengisuAkay as BengisuAkay
    from user_forces.friction.laws import BrownMcPhee as BrownMcPhee
    from user_forces.friction.laws import CubicCoulomb as CubicCoulomb
    from user_forces.friction.laws import Frictionless as Frictionless
    from user_forces.friction.laws import Stribeck as Stribeck
    from user_forces.friction.laws import Threlfall as Threlfall
    from user_forces.friction.lugre import LuGre as LuGre
    from user_forces.journal import Face as Face
    from user_forces.journal import JournalBearing as JournalBearing
    from user_forces.journal import Slot as Slot
    from user_forces.materials import STEEL as STEEL
    from user_forces.materials import STEEL_35CRMO as STEEL_35CRMO
    from user_forces.materials import Material as Material
    from user_forces.materials import effective_modulus as effective_modulus
    from user_forces.materials import external_contact_stiffness as external_contact_stiffness
    from user_forces.materials import internal_contact_stiffness as internal_contact_stiffness
    from user_forces.normal.cylinders import CylinderLaw as CylinderLaw
    from user_forces.normal.cylinders import DubowskyFreudenstein as DubowskyFreudenstein
    from user_forces.normal.cylinders import Esdu78035 as Esdu78035
    from user_forces.normal.cylinders import Goldsmith as Goldsmith
    from user_forces.normal.cylinders import Johnson as Johnson
    from user_forces.normal.cylinders import Liu as Liu
    from user_forces.normal.cylinders import Pereira as Pereira
    from user_forces.normal.cylinders import Radzimovsky as Radzimovsky
    from user_forces.normal.dashpots import AdamsImpact as AdamsImpact
    from user_forces.normal.dashpots import Anagnostopoulos as Anagnostopoulos
    from user_forces.normal.dashpots import KelvinVoigt as KelvinVoigt
    from user_forces.normal.hysteresis import Hysteresis as Hysteresis
    from user_forces.normal.hysteresis import delivered_restitution as delivered_restitution
    from user_forces.normal.hysteresis import exact_damping_factor as exact_damping_factor
    from user_forces.normal.law import LoadError as LoadError
    from user_forces.normal.law import NormalLaw as NormalLaw
    from user_forces.normal.pin_in_bore import PinInBore as PinInBore
    from user_forces.normal.power_laws import CarvalhoMartins as CarvalhoMartins
    from user_forces.normal.power_laws import Exact as Exact
    from user_forces.normal.power_laws import Flores as Flores
    from user_forces.normal.power_laws import GharibHurmuzlu as GharibHurmuzlu
    from user_forces.normal.power_laws import Gonthier as Gonthier
    from user_forces.normal.power_laws import HerbertMcWhannell as HerbertMcWhannell
    from user_forces.normal.power_laws import Hertz as Hertz
    from user_forces.normal.power_laws import HuGuo as HuGuo
    from user_forces.normal.power_laws import HuntCrossley as HuntCrossley
    from user_forces.normal.power_laws import LankaraniNikravesh as LankaraniNikravesh
    from user_forces.normal.power_laws import LeeWang as LeeWang
    from user_forces.normal.power_laws import PowerLaw as PowerLaw
    from user_forces.normal.power_laws import SafaeifarFarshidianfar as SafaeifarFarshidianfar
    from user_forces.normal.power_laws import ZhiyingQishao as ZhiyingQishao
    from user_forces.own_laws import friction_law as friction_law
    from user_forces.own_laws import normal_law as normal_law
    from user_forces.values.value import InputError as InputError
    from user_forces.values.value import Value as Value
    from user_forces.values.value import value as value

_PLACES = for_types(__file__)
__getattr__, __dir__ = offered(__name__, _PLACES)
keep_classes(__name__, {**_PLACES, ".normal.part": ("PartOf",)})
