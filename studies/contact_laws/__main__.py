"""`python -m studies.contact_laws`."""

import sys

from studies.contact_laws.run import main

if __name__ == "__main__":
    sys.exit(main())
