"""Spectrum of a pin force: amplitudes by frequency, and how they change over time."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy import signal

from support_exudyn.postprocessing.figures import style, units
from support_exudyn.postprocessing.figures.journal import Series, chosen_pin, shortest_impact
from support_exudyn.postprocessing.figures.selection import as_words, inside, window_text
from support_exudyn.postprocessing.figures.units import readable
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

WINDOW = "hann"
TREND: Any = "linear"  # which is taken out of pieces; types of scipy lack it
WIDTH = 1.5  # of the window in the frequency, in bins: what a pure tone is smeared over
SEGMENTS = 4  # of equal length that a piece is cut into; overlapping by half, seven are averaged
FEWEST = 16  # records that a spectrum is made of
EVEN = 1e-6  # share of the spacing by which records may be off
LETTERS = "ABC"  # of the peaks that are marked
MANY = 1000  # frequencies from which on their axis is logarithmic
CLOSE = 0.03  # of the width of a panel: letters closer would lie upon one another
LOWEST = 1e-3  # amplitude of a peak, of the largest one; lower ones are RMS fluctuation
PROMINENCE = 3.0  # by how much a peak stands out of what is around it, as a factor of the amplitude
FINE_ENOUGH = 10.0  # records within the shortest impact, for its spectrum not to be folded
TINY = 1e-12  # of the largest amplitude: below, nothing is drawn
COLOURS = "Greys"


@dataclass(frozen=True)
class Spectrum:
    """The spectrum of a quantity of unit U that was sampled at equal times.

    frequency: (m,) [Hz]. amplitude: of a sine of each frequency [U], (m,). resolution: between two frequencies
    [Hz]. spacing: between two samples [s]. averaged: how many overlapping segments. resampled: whether the
    samples had to be interpolated to equal times.
    """

    frequency: Series
    amplitude: Series
    resolution: float
    spacing: float
    averaged: int
    resampled: bool

    @property
    def nyquist(self) -> float:
        """Highest frequency that the samples resolve [Hz]; what is faster appears below it."""
        return 0.5 / self.spacing

    def peaks(self) -> list[tuple[float, float]]:
        """Frequency [Hz] and amplitude [U] of the highest peaks that stand out, the highest first."""
        if not self.amplitude.max() > 0.0:
            return []
        levels = np.log(np.maximum(self.amplitude, TINY * self.amplitude.max()))
        found, _ = signal.find_peaks(
            levels, height=math.log(LOWEST * self.amplitude.max()), prominence=math.log(PROMINENCE)
        )
        highest = sorted(found.tolist(), key=lambda n: -self.amplitude[n])[: len(LETTERS)]
        return [(float(self.frequency[n]), float(self.amplitude[n])) for n in highest]


def spectrum(time: Series, values: Series, segments: int = SEGMENTS) -> Spectrum:
    """Welch's averaged spectrum: segments that overlap by half, each without its straight trend, Hann's window.

    Arguments:
        time: of the samples [s], (n,), increasing. Samples that are not equally spaced are interpolated.
        values: (n,).
        segments: how many of equal length the piece is cut into; 1: resolved most finely, not averaged.

    Raises InputError if the samples are too few.
    """
    values, spacing, resampled = equally_spaced(time, values)
    length = values.size // segments
    if length < FEWEST:
        raise InputError(
            f"a spectrum of {values.size} records in {segments} segments: allowed: at least "
            f"{FEWEST * segments} records"
        )
    frequency, power = signal.welch(values, 1.0 / spacing, WINDOW, length, detrend=TREND, scaling="spectrum")
    averaged = (values.size - length) // (length - length // 2) + 1
    return Spectrum(frequency, np.sqrt(2.0 * power), float(frequency[1]), spacing, averaged, resampled)


def equally_spaced(time: Series, values: Series) -> tuple[Series, float, bool]:
    """Samples at equal times, their spacing [s], and whether they had to be interpolated.

    A last one off the grid, at the end of a run, is left out.
    """
    if time.size < FEWEST:
        raise InputError(f"a spectrum of {time.size} records: allowed: at least {FEWEST}")
    steps = np.diff(time)
    spacing = float(np.median(steps))
    if abs(steps[-1] - spacing) > EVEN * spacing:
        time, values, steps = time[:-1], values[:-1], steps[:-1]
    # by the whole length: rounding of single times does not matter
    if np.all(np.abs(steps - spacing) <= EVEN * spacing):
        return values, float((time[-1] - time[0]) / (time.size - 1)), False
    even = np.arange(time[0], time[-1] + 0.5 * spacing, spacing)
    return np.interp(even, time, values), spacing, True


def force_spectrum(
    result: Result, pin: str | None = None, after: float = 0.0, until: float = math.inf
) -> Figure:
    """Spectrum of the force in a pin, and how it changes over the time (spectrogram).

    Arguments:
        pin: name of a pin, with clearance or ideal; the first with clearance by default, or the first one.
        after, until: of the piece of the run [s].

    Raises InputError if there is no such pin, or too few records lie between the times.
    """
    pin = chosen_pin(result, pin, with_clearance=False)
    chosen = inside(result, after, until, FEWEST)
    time, force = result.time[chosen], result[f"pin.{pin}.force"][chosen]
    found = spectrum(time, force)
    drawing = style.begin(
        170, 130, f"spectrum of the force in {as_words(pin)}, {window_text(result, after, until)}"
    )
    amplitudes, over_time = drawing.subplots(2, 1)
    _draw(amplitudes, found, style.CONTACT if pin in result.onsets else style.IDEAL)
    _draw_over_time(over_time, time, force)
    impacts = tuple(one for one in result.onsets.get(pin, ()) if time[0] <= one.time <= time[-1])
    text = (
        f"Amplitude of a sine of each frequency, from records every {units.amount(found.spacing, 's', 4)}"
        f"{' (interpolated to equal times)' if found.resampled else ''}: Welch's mean of {found.averaged} "
        f"overlapping pieces, without straight trend, Hann's window. Bins of "
        f"{units.amount(found.resolution, 'Hz')}, a tone is {WIDTH:g} bins wide; "
        f"nothing is known above {units.amount(found.nyquist, 'Hz', 4)}. In (b) 0 dB is the largest amplitude. "
        "The records sample the force: what is faster than that, such as brief impacts, appears at lower "
        "frequencies (aliasing); a smaller record_period shows it."
    )
    if (shortest := shortest_impact(impacts)) < FINE_ENOUGH * found.spacing:
        text += (
            f" The shortest impact lasts {units.amount(shortest, 's')}: a record_period of "
            f"{units.amount(shortest / FINE_ENOUGH, 's')} would follow it."
        )
    style.caption(drawing, text)
    return drawing


def _draw(axes: Axes, found: Spectrum, colour: str) -> None:
    unit, hertz = readable("N", float(found.amplitude.max())), readable("Hz", found.nyquist)
    amplitude, frequencies = unit.scale * found.amplitude[1:], hertz.scale * found.frequency[1:]
    axes.plot(frequencies, amplitude, color=colour, lw=0.9)
    axes.set(title="a) amplitudes", xlabel=f"frequency [{hertz.name}]", ylabel=f"amplitude [{unit.name}]")
    axes.set_xlim(0.0, hertz.scale * found.nyquist)
    if frequencies.size > MANY:  # low frequencies, where machines run, would be a line at the edge
        axes.set_xscale("log")
        axes.set_xlim(frequencies[0], hertz.scale * found.nyquist)
    if not (highest := float(amplitude.max())) > 0.0:
        return
    axes.set(yscale="log", ylim=(max(0.5 * float(amplitude.min()), 1e-9 * highest), 20.0 * highest))
    drawn: list[tuple[float, int]] = []
    for letter, (frequency, height) in zip(LETTERS, found.peaks(), strict=False):
        place = hertz.scale * frequency, unit.scale * height
        across = float((axes.transData + axes.transAxes.inverted()).transform(place)[0])
        # one above the other where peaks are close
        above = max((up + 8 for other, up in drawn if abs(across - other) < CLOSE), default=4)
        drawn.append((across, above))
        half_a_bin = 0.5 * hertz.scale * found.resolution
        label = f"{letter}: {place[0]:.4g} ± {half_a_bin:.2g} {hertz.name}, {place[1]:.3g} {unit.name}"
        axes.plot(*place, "v", ms=4, color=style.IDEAL, mfc="white", mew=0.8)
        axes.annotate(letter, place, (0, above), textcoords="offset points", ha="center", fontsize=7)
        axes.plot([], [], ls="none", label=label)
    if drawn:
        axes.legend(loc="upper right", fontsize=7, handlelength=0.0, title="highest peaks", title_fontsize=7)


def _draw_over_time(axes: Axes, time: Series, force: Series) -> None:
    """Amplitudes over time and frequency, dark where they are large."""
    values, spacing, _ = equally_spaced(time, force)
    length = max(FEWEST, min(256, values.size // 16))
    frequency, moments, power = signal.spectrogram(
        values, fs=1.0 / spacing, window=WINDOW, nperseg=length, noverlap=length // 2, detrend=TREND,
        scaling="spectrum",
    )  # fmt: skip
    amplitude = np.sqrt(2.0 * power)
    largest = max(float(amplitude.max()), 1e-300)
    levels = 20.0 * np.log10(np.maximum(amplitude, 1e-4 * largest) / largest)
    seconds, hertz = readable("s", float(np.ptp(time))), readable("Hz", 0.5 / spacing)
    drawn = axes.pcolormesh(
        seconds.scale * (time[0] + moments), hertz.scale * frequency, levels, cmap=COLOURS, vmin=-80.0,
        vmax=0.0, shading="nearest", rasterized=True,
    )  # fmt: skip
    axes.set(xlabel=f"time [{seconds.name}]", ylabel=f"frequency [{hertz.name}]")
    axes.set(xlim=seconds.scale * time[[0, -1]], ylim=(0.0, hertz.scale * 0.5 / spacing))
    axes.grid(False)
    piece = units.amount(length * spacing, "s")
    axes.set_title(f"b) over time, pieces of {piece}, resolved to {1.0 / (length * spacing):.3g} Hz")
    axes.figure.colorbar(drawn, ax=axes, label="amplitude [dB]", pad=0.01)
