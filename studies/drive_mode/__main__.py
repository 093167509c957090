"""`python -m studies.drive_mode`."""

import sys

from studies.drive_mode.run import main

if __name__ == "__main__":
    sys.exit(main())
