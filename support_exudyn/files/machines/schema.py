"""JSON Schema of machine data files."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic.json_schema import models_json_schema

from support_exudyn.files.machines.form import MachineForm

DRAFT = "https://json-schema.org/draft/2020-12/schema"


def whole_schema(forms: Mapping[str, type[MachineForm]]) -> dict[str, Any]:
    """One schema for files of all kinds, which are told apart by their key `kind`."""
    references, definitions = models_json_schema([(form, "validation") for form in forms.values()])
    return {
        "$schema": DRAFT,
        "title": "Machine of support-exudyn",
        "description": "Bodies, pivots and masses of one machine; mm, kg and degrees.",
        "type": "object",
        "required": ["kind"],
        "oneOf": [references[form, "validation"] for form in forms.values()],
        "$defs": definitions["$defs"],
    }
