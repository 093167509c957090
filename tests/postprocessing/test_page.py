"""Pieces of a page: what is shown, what is safe, and what it weighs."""

from __future__ import annotations

import base64
import hashlib
import re

from jinja2 import DictLoader

from support_exudyn.postprocessing.page.pieces import (
    FileLink,
    KeyNumber,
    Sheet,
    ShownFigure,
    ShownTable,
    policy,
    templates,
)

HOSTILE = "<script>alert(1)</script>"
TEMPLATE = """{% extends "base.html.j2" %}
{% from "macros.html.j2" import table, figure, tiles %}
{% block title %}{{ title }}{% endblock %}
{% block nav %}<ol><li><a href="#t">T</a></li></ol>{% endblock %}
{% block main %}{{ tiles(numbers) }}{{ figure(shown) }}{{ table(sheet) }}{% endblock %}
"""


def page(text: str, scripts: str = "") -> str:
    return (
        templates(DictLoader({"page": TEMPLATE}))
        .get_template("page")
        .render(
            title=text,
            scripts=scripts,
            numbers=[KeyNumber(text, "2.0 ± 0.1 kN", before="1 kN", note=text)],
            shown=ShownFigure("data:,", text, anchor="f", label="Fig. 1"),
            sheet=ShownTable(
                Sheet(text, ("a", text), ((text, "1.5"),), text), "t", "Table 1", (FileLink(text, "a.csv"),)
            ),
        )
    )


def test_text_stays_text_and_anchors_are_there() -> None:
    shown = page(HOSTILE)
    assert HOSTILE not in shown
    assert "&lt;script&gt;alert(1)" in shown
    assert 'id="f"' in shown
    assert 'id="t"' in shown
    assert "<b>2.0</b> ± 0.1 kN" in shown


def test_the_policy_allows_the_scripts_of_the_page_and_no_other() -> None:
    shown = page("x")
    (script,) = re.findall(r"<script>(.*?)</script>", shown, re.DOTALL)
    own = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    (stated,) = re.findall(r'Content-Security-Policy" content="(.*?)"', shown)
    assert stated.replace("&#39;", "'") == (
        f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'sha256-{own}'"
    )
    assert policy(['<script type="application/json">{}</script>']).endswith("script-src 'none'")
