"""Command lines of `python -m support_exudyn` of any words: taken, or exit code 2 with a usage and one line."""

from __future__ import annotations

import argparse

from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.commands.parser import NAMES, parser
from tests import strategies as some
from tests.commands.test_fuzz_commands import outcome, words

options = st.sampled_from(
    (
        *(
            "--all",
            "--from",
            "--after",
            "--until",
            "--difference",
            "--tornado",
            "--histogram",
            "--orbit",
            "--poincare",
            "--spectrum",
            "--pin",
            "--phase",
        ),
        *(
            "--out",
            "--show",
            "--to",
            "--every",
            "--frames-per-second",
            "--speed",
            "--movie",
            "--size",
            "--still",
        ),
        *("--solution", "xdmf", "gif", "1280x720", "1x", "0.5", "-1", "rise.h5", "tip.x", "--to=csv"),
    )
)


@given(command=st.sampled_from(list(NAMES)) | words, rest=st.lists(options | words, max_size=6))
@some.tried("options")
def test_words_are_taken_or_refused(command: str, rest: list[str]) -> None:
    given_, code, said = outcome(lambda: parser().parse_args([command, *rest]))
    assert code in (None, 0, 2)
    if code == 2:
        usage, found, wrong = said.rpartition("error: ")
        assert usage.startswith("usage: python -m support_exudyn")
        assert found
        assert 0 < len(wrong.strip()) < 1000
        assert "\n" not in wrong.strip()
    elif code is None:
        assert isinstance(given_, argparse.Namespace)
        assert given_.command in NAMES
