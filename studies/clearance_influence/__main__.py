"""`python -m studies.clearance_influence`."""

import sys

from studies.clearance_influence.run import main

if __name__ == "__main__":
    sys.exit(main())
