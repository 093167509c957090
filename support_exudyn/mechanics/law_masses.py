"""The masses of contact laws that need one: constants of a run, from the start posture.

The inverse effective mass W (2, 2) of a journal against its bore has all other clearance joints open and all
actuators rigid. It depends on the direction. A pin's mass is 2 / trace(W), the harmonic mean over all
directions; a guide's mass is the harmonic mean of that along the normals of its corners.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from support_exudyn.mechanics.contact_places import ContactPlace, contact_places
from support_exudyn.mechanics.kinetics import Kinetics
from support_exudyn.model.guides import ClearanceGuide, Guide
from support_exudyn.model.linkage import Linkage
from support_exudyn.model.pins import ClearancePin
from user_forces.normal.law import NormalLaw


def lacks_mass(law: NormalLaw) -> bool:
    """Whether a law has a field `mass` without a number."""
    return getattr(law, "mass", 0.0) is None


def with_mass(pin: ClearancePin, name: str, linkage: Linkage, free: Kinetics) -> ClearancePin:
    """The pin with a mass in its law; linkage: in the start posture. free: with all clearance joints open."""
    law: Any = pin.contact.normal
    places = contact_places(linkage, {name: pin}, {})
    return replace(pin, contact=replace(pin.contact, normal=replace(law, mass=_mass(places.values(), free))))


def guide_with_mass(guide: ClearanceGuide, name: str, linkage: Linkage, free: Kinetics) -> ClearanceGuide:
    """The guide with a mass in its law, see `with_mass`."""
    law: Any = guide.normal
    guides: Mapping[str, Guide] = {name: guide}
    return replace(guide, normal=replace(law, mass=_mass(contact_places(linkage, {}, guides).values(), free)))


def _mass(places: Iterable[ContactPlace], free: Kinetics) -> float:
    """The harmonic mean of the effective masses at places of contact in the start posture [kg]."""
    still, found = np.zeros(3 * len(free.linkage.bodies)), []
    for place in places:
        inverse = free.inverse_mass(still, place.rate(free.motion(still)))
        along = place.axes(free.linkage)
        normal = np.array([-np.sin(along), np.cos(along)])
        found.append(normal @ inverse @ normal if place.contact.bearing.is_slot else 0.5 * np.trace(inverse))
    return 1.0 / float(np.mean(found))
