"""`python -m support_exudyn COMMAND ...`, see `support_exudyn.commands.parser`."""

import sys
import warnings
from collections.abc import Sequence

from support_exudyn.commands.command_line import answered, warn
from support_exudyn.simulation.at_start import be_interruptible


def main(argv: Sequence[str] | None = None) -> int:
    """Do what the command line asks for. Returns the exit code."""
    return answered(lambda: _asked(argv))


def _asked(argv: Sequence[str] | None) -> None:
    from support_exudyn.commands.parser import at_work, command, import_modules, parser

    given = parser().parse_args(argv)  # with the libraries of the command: long enough to be interrupted
    be_interruptible()
    imports = given.imports + given.more_imports
    import_modules(imports)
    with at_work(imports), warnings.catch_warnings():
        warnings.showwarning = lambda message, *_: warn(f"warning: {message}")
        command(given.command).run(given)


if __name__ == "__main__":
    sys.exit(main())
