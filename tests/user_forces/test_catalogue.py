"""Laws are found in their files: what is imported by name, and the tables, are all of them."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import user_forces
from user_forces.catalogue import laws, source, title, year
from user_forces.friction.law import FrictionLaw
from user_forces.normal.law import NormalLaw
from user_forces.values.value import Value, kinds_of

FOUND = laws(NormalLaw) | laws(FrictionLaw)
LAWS = Path(user_forces.__file__).parent / "laws.md"


def test_every_law_of_ours_is_in_the_catalogue_but_those_without_a_source() -> None:
    of_ours = {
        law.__name__
        for kind in (NormalLaw, FrictionLaw)
        for law in kinds_of(kind).values()
        if law.__module__.startswith("user_forces.")
    }
    assert of_ours - {law.__name__ for law in FOUND.values()} == {"Frictionless", "PartOf"}


@pytest.mark.parametrize("name", FOUND)
def test_a_law_is_offered_by_name_and_told(name: str) -> None:
    law: type[Value] = FOUND[name]
    assert getattr(user_forces, law.__name__) is law
    assert f"`{law.__name__}`" in LAWS.read_text(encoding="utf-8")
    assert title(law)
    assert source(law)
    assert 1850 < year(law) < 2100 or name == "adams_impact"


def test_the_page_tells_what_laws_deliver() -> None:
    rows = re.findall(r"^\|[ *]*`(\w+)`.*?\|((?: [.]\d{3} \|){5})$", LAWS.read_text(encoding="utf-8"), re.M)
    told = {name: [float(one) for one in re.findall(r"[.]\d{3}", numbers)] for name, numbers in rows}
    asked: Any = laws(user_forces.PowerLaw).values()
    assert {law.__name__ for law in asked} == told.keys() - {"Anagnostopoulos"}
    for law in asked:
        delivered = [law(stiffness=1e8, restitution=e).delivered_restitution for e in (0.1, 0.3, 0.5, 0.7, 0.9)]
        assert told[law.__name__] == pytest.approx(delivered, abs=6e-4)


def test_the_reference_comes_first_then_the_oldest() -> None:
    power = list(laws(user_forces.PowerLaw))
    assert power[:3] == ["exact", "hunt_crossley", "herbert_mcwhannell"]
    assert next(iter(laws(user_forces.CylinderLaw))) == "johnson"
