"""What does a number cost: the error of a pin force over processor time, by this program and by others.

The largest force in the rear-link pin over the paper's rise, by every program that is installed and by ever
finer settings; settings that take minutes are left to the benchmark.
"""

from collections.abc import Sequence

from studies.benchmarking import benchmark, trade
from studies.benchmarking.trade import TradePoint
from studies.common.numbers import Number
from studies.common.options import Options
from studies.common.study import Study, StudyOutcome
from studies.common.words import text_table


def work(chosen: Options) -> StudyOutcome:
    """Measure the programs one after another, for they are timed; no run is kept."""
    del chosen
    return outcome(list(trade.measured()))


def outcome(points: Sequence[TradePoint]) -> StudyOutcome:
    """What is said of the settings of all programs."""
    sheet, exact = benchmark.points_sheet(points), trade.exact_force()
    own_error = exact.error / exact.value
    numbers = [Number("largest pin force", "reference", exact.value, "N", exact.error)]
    name = "relative error of the largest pin force"
    numbers += [Number(name, f"{one.program}, {one.setting}", one.error, "1", own_error) for one in points]
    best = {name: trade.cheapest(points, name) for name in dict.fromkeys(one.program for one in points)}
    words = {
        "exact": exact,
        "good": trade.GOOD,
        "work": trade.WORK,
        "best": best,
        "headline": (trade.OURS_COMPILED + trade.ONCE, trade.STOCK),
        "presets": [one for one in points if one.program in (trade.OURS_COMPILED, trade.OURS_ENGINE)],
        "caption": trade.CAPTION,
        "table_caption": sheet.caption,
    }
    tables = {"settings": text_table(sheet.header, sheet.rows, left=sheet.left)}
    return StudyOutcome(numbers, words, {benchmark.FIGURE: trade.figure(points)}, tables)


study = Study("speed_accuracy", __doc__, work, seconds=120.0)
