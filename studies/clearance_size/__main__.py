"""`python -m studies.clearance_size`."""

import sys

from studies.clearance_size.run import main

if __name__ == "__main__":
    sys.exit(main())
