"""`python -m studies.claims`."""

import sys

from studies.claims.run import main

if __name__ == "__main__":
    sys.exit(main())
