"""The page of a comparison: verdict, tables, curves to look into, all measures with their definitions."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.comparing import further_tables as further
from support_exudyn.postprocessing.comparing import told
from support_exudyn.postprocessing.comparing.compare_figure import (
    MOST,
    OTHERS,
    compare_figure,
    reach,
    size_of_difference,
)
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair, FilesCompared
from support_exudyn.postprocessing.comparing.sentences import sentences
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.units import readable
from support_exudyn.postprocessing.page.live import Dash, Drawn, LiveFigure, LivePanel, live_panel
from support_exudyn.postprocessing.page.live_html import html
from support_exudyn.postprocessing.page.pieces import (
    KeyNumber,
    Sheet,
    ShownFigure,
    ShownTable,
    image,
    templates,
)
from user_forces.values.value import InputError

IMPACTS = "Impacts"
TEMPLATE = "compare.html.j2"
ENDING = ".html"
DIGITS = 5
MOST_POINTS = 60  # of a curve that are drawn as marks
MEASURES = {  # what the page says of each, by its name
    "rms": ("RMS difference", "root of the mean square of the difference over time"),
    "rms_of_range": ("RMS / range", "the same over the largest less the least value of the reference"),
    "largest": ("largest difference", "the difference that is largest in size, with its sign"),
    "largest_of_range": ("largest / range", "its size over the range of the reference"),
    "largest_time": ("at [s]", "when that is"),
    "mean_difference": ("mean difference", "mean of the difference over time"),
    "spread_reference": ("spread, reference", "standard deviation of the reference over time"),
    "spread_other": ("spread, other", "that of the other"),
    "spread_difference": ("spread of difference", "that of the difference"),
    "peak_reference": ("peak, reference", "the value of the reference that is largest in size"),
    "peak_other": ("peak, other", "that of the other"),
    "r_squared": ("R²", "1 less mean square of the difference over the variance of the reference"),
    "magnitude_error": ("Sprague-Geers M", "RMS of the other over that of the reference, less 1"),
    "phase_error": (
        "Sprague-Geers P",
        "angle between both curves over pi: 0 of a multiple, 1 of a negative one",
    ),
    "combined_error": ("Sprague-Geers C", "root of M² + P²"),
}
RATING = (
    "ISO/TS 18571",
    f"rating from 0 to 1, of curves up to 2 s, of the first {MOST} channels: it takes its time",
)
SHARES = {"rms_of_range", "largest_of_range", "magnitude_error", "phase_error", "combined_error"}
PLAIN = {"r_squared", "largest_time"}


@dataclass(frozen=True)
class ComparedFilePart:
    """What the page says of a file."""

    name: str
    anchor: str
    faults: tuple[str, ...]
    sentences: tuple[str, ...]
    channels: ShownTable
    curves: ShownFigure | None
    tables: tuple[ShownTable, ...]


@dataclass(frozen=True)
class ComparePage:
    """What the page says."""

    title: str
    verdict: str
    tiles: tuple[KeyNumber, ...]
    sources: ShownTable
    files: tuple[ComparedFilePart, ...]
    definitions: ShownTable
    measures: tuple[ShownTable, ...]


def check_page(path: Path) -> None:
    """Raise InputError for a page's file of a kind that is not written."""
    if path.suffix.lower() != ENDING:
        raise InputError(f"{path}: allowed: a file that ends in {ENDING}")


def write_page(found: FilesCompared, path: Path) -> None:
    """Write the page, whole or not at all."""
    check_page(path)
    text = compare_page(found)
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def compare_page(found: FilesCompared) -> str:
    """The page of a comparison as HTML that needs nothing from elsewhere."""
    live = {f"curves{n}": _live(pair) for n, pair in enumerate(found.pairs)}
    pages = html(live)
    parts = tuple(
        _part(found, n, pair, Markup(pages.places[f"curves{n}"])) for n, pair in enumerate(found.pairs)
    )
    names = [pair.other.name for pair in found.pairs]
    page = ComparePage(
        f"{', '.join(names)} compared with {found.reference.name}",
        told.VERDICTS[found.verdict],
        _tiles(found),
        ShownTable(_sources(found), "sources"),
        parts,
        ShownTable(_definitions(), "definitions"),
        tuple(ShownTable(_measures(pair), f"measures{n}") for n, pair in enumerate(found.pairs)),
    )
    return templates().get_template(TEMPLATE).render(page=page, scripts=Markup(pages.scripts))


def _tiles(found: FilesCompared) -> tuple[KeyNumber, ...]:
    """How many channels are within, not within, not decided; of two files also when they part."""
    channels = [one for pair in found.pairs for one in pair.channels.values()]
    tiles = []
    if found.verdict == "told":
        tiles.append(KeyNumber("channels compared", str(len(channels))))
    else:
        judged = [one for one in channels if one.tolerance is not None]
        for verdict in ("within", "not within", "not decided"):
            count = sum(one.verdict == verdict for one in channels)
            tiles.append(
                KeyNumber(f"channels {verdict}", f"{count}", note=f"of {len(judged)} with a tolerance")
            )
    parting = min(pair.parting.time for pair in found.pairs)
    if math.isfinite(parting):
        tiles.append(KeyNumber("point by point up to", f"{parting:.6g} s"))
    return tuple(tiles)


def _sources(found: FilesCompared) -> Sheet:
    files = [found.reference, *(pair.other for pair in found.pairs)]
    rows = [
        (
            "reference" if n == 0 else "compared",
            one.name,
            one.kind,
            str(one.path),
            "known" if one.has_errors else "not known",
        )
        for n, one in enumerate(files)
    ]
    return Sheet("Files", ("", "name", "kind", "path", "numerical errors"), tuple(rows), wide=True)


def _part(found: FilesCompared, number: int, pair: ComparedPair, live: Markup) -> ComparedFilePart:
    tables = [
        Sheet(title, tuple(head.lstrip(">") for head in header), tuple(rows), note, left=1 + (title != IMPACTS))
        for title, header, rows, note in (
            (
                f"Statistics after {pair.parting.time:.6g} s",
                further.STATISTICS,
                further.statistics_rows(pair),
                "From, to: confidence interval of the difference, by the stationary block bootstrap.",
            ),
            (IMPACTS, further.IMPACTS, further.impacts_rows(pair), "Matched in their order."),
            ("RMS in bands of frequency", further.BANDS, further.bands_rows(pair), ""),
        )
        if rows
    ]
    rows = [told.header(pair), *told.rows(pair)]
    if pair.verdict != "told":  # the verdict stands beside the name
        rows = [(row[0], row[-1], *row[1:-1]) for row in rows]
    header = tuple(head.lstrip(">") for head in rows[0])
    sheet = Sheet(
        told.title(pair), header, tuple(rows[1:]), _channels_note(pair), left=len(header) - len(told.HEADER) + 2
    )
    return ComparedFilePart(
        pair.other.name,
        f"file{number}",
        tuple(filter(None, map(told.fault, pair.channels.values()))),
        tuple(line[:1].upper() + line[1:].rstrip(".") for line in sentences(pair)),
        ShownTable(sheet, f"channels{number}"),
        _curves(found, pair, live),
        tuple(ShownTable(one, f"table{number}_{n}") for n, one in enumerate(tables)),
    )


def _channels_note(pair: ComparedPair) -> str:
    before = " before the parting" if math.isfinite(pair.parting.time) else ""
    return (
        f"Means are over all times. Largest difference, RMS over the reference's range and C of Sprague and "
        f"Geers{before}. "
        "Beside errors: whether the largest difference is larger than the numerical errors that are known."
    )


def _curves(found: FilesCompared, pair: ComparedPair, live: Markup) -> ShownFigure:
    """The curves to look into, and as printed: of the first channels if they are many."""
    names = list(pair.channels)[:MOST]
    one = FilesCompared(found.reference, (_only(pair, names),), found.after, found.until)
    rest = (
        f" Printed are the first {MOST} of {len(pair.channels)} channels." if len(pair.channels) > MOST else ""
    )
    caption = (
        f"Curves, and below each what differs from {pair.reference.name}.{rest} Thinned so that no peak is "
        "lost."
    )
    return ShownFigure(_picture(compare_figure(one)), caption, live)


def _only(pair: ComparedPair, names: Sequence[str]) -> ComparedPair:
    return replace(pair, channels={name: pair.channels[name] for name in names})


def _picture(drawing: Figure) -> str:
    """A drawing as a data URI."""
    with tempfile.TemporaryDirectory() as folder, style.look():
        path = Path(folder) / "drawing.png"
        drawing.savefig(path)
        return image(path)


def _live(pair: ComparedPair) -> LiveFigure:
    """Two panels a channel: the curves, and what differs with what is allowed."""
    panels = [panel for one in pair.channels.values() for panel in _panels(pair, one)]
    return LiveFigure("time [s]", tuple(panels))


def _panels(pair: ComparedPair, one: ComparedChannel) -> tuple[LivePanel, LivePanel]:
    colour, time = OTHERS[0][0], one.common.time
    curves = []
    for file, shade in ((pair.reference, style.IDEAL), (pair.other, colour)):
        own, values = file.time(one.name), file.values(one.name, one.unit)
        chosen = (own >= time[0]) & (own <= time[-1])
        curves.append((file, own[chosen], values[chosen], shade))
    unit = readable(one.unit, max(float(np.nanmax(np.abs(values), initial=0.0)) for _, _, values, _ in curves))
    few: dict[bool, Dash] = {True: "points", False: "solid"}
    drawn = [
        Drawn(
            file.name, own, unit.scale * values, shade, few[file.run is None and own.size <= MOST_POINTS], 1.1
        )
        for file, own, values, shade in curves
    ]
    piece = slice(0, one.before or None)  # after the parting differences tell nothing
    when, apart = time[piece], (one.common.other - one.common.reference)[piece]
    small = readable(one.unit, float(np.nanmax(np.abs(apart), initial=0.0)))
    lines: list[Drawn] = []
    if np.isfinite(one.errors).any():
        lines = [
            Drawn(f"difference {sign} errors", when, small.scale * (apart + way * one.errors[piece]), "#bbbbbb")
            for sign, way in (("+", 1.0), ("-", -1.0))
        ]
    lines.append(Drawn("difference", when, small.scale * apart, colour, "solid", 1.1))  # over its errors
    if math.isfinite(one.allowed) and not reach(one.allowed, size_of_difference(one))[1]:
        ends = time[[0, -1]]
        lines += [
            Drawn("allowed", ends, np.full(2, sign * small.scale * one.allowed), "#009E73", "dashed", 0.9)
            for sign in (1.0, -1.0)
        ]
    return (
        live_panel(f"{one.name} [{unit.name}]", drawn),
        live_panel(f"difference [{small.name}]", lines),
    )


# --- all measures ---


def _definitions() -> Sheet:
    rows = [*MEASURES.values(), RATING]
    return Sheet(
        "Measures, before the parting if there is one", ("measure", "what it is"), tuple(rows), wide=True
    )


def _measures(pair: ComparedPair) -> Sheet:
    """A row a measure, a column a channel."""
    channels = list(pair.channels.values())
    rows = [(head, *(_measure(one, name) for one in channels)) for name, (head, _) in MEASURES.items()]
    rows.append((RATING[0], *(_rating(one) if n < MOST else told.NONE for n, one in enumerate(channels))))
    return Sheet(f"{pair.other.name} less {pair.reference.name}", ("measure", *pair.channels), tuple(rows))


def _measure(one: ComparedChannel, name: str) -> str:
    found = getattr(one.measures, name)
    value = found.value if name.startswith("peak") else found
    if math.isnan(value):
        return told.NONE
    if name in SHARES:
        return told.share(value)
    if name in PLAIN:
        return _plain(value)
    unit = readable(one.unit, abs(value))
    return f"{unit.scale * value:.{DIGITS}g} {unit.name}"


def _rating(one: ComparedChannel) -> str:
    return told.NONE if one.rating is None else _plain(one.rating.overall)


def _plain(value: float) -> str:
    return told.NONE if math.isnan(value) else f"{value:.{DIGITS}g}"
