"""`python -m studies.which_pin`."""

import sys

from studies.which_pin.run import main

if __name__ == "__main__":
    sys.exit(main())
