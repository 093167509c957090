"""`python -m support_exudyn COMMAND ...`, see `support_exudyn.commands.app`."""

import sys

from support_exudyn.commands.app import main

if __name__ == "__main__":
    sys.exit(main())
