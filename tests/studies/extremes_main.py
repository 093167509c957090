"""Scenes judged one after the other and kept; the last one takes for ever, whoever began this kills it."""

import sys
from pathlib import Path

from studies.extremes import runs
from tests.at_once import at_once
from tests.studies import test_extremes as scenes

if __name__ == "__main__":
    chosen = [scenes.of(scenes.impact, "impact"), scenes.of(scenes.refused, "refused")]
    runs.run_all([*chosen, scenes.of(scenes.sleep, "sleep")], {}, at_once(), Path(sys.argv[1]))
