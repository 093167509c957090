"""Figures on disk."""

from __future__ import annotations

from pathlib import Path

from matplotlib.figure import Figure

from support_exudyn.postprocessing.figures import style


def drawing() -> Figure:
    figure = Figure(figsize=style.size(50.8, 25.4))
    figure.subplots().plot([0, 1], [0, 1])
    return figure


def test_a_figure_is_written_as_png_and_pdf(tmp_path: Path) -> None:
    with style.look():
        png, pdf = style.save(drawing(), tmp_path, "line")
    assert png.read_bytes().startswith(b"\x89PNG")
    assert pdf.read_bytes().startswith(b"%PDF")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["line.pdf", "line.png"]
