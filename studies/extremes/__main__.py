"""`python -m studies.extremes`."""

import sys

from studies.extremes.run import main

if __name__ == "__main__":
    sys.exit(main())
