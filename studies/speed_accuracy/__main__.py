"""`python -m studies.speed_accuracy`."""

import sys

from studies.speed_accuracy.run import main

if __name__ == "__main__":
    sys.exit(main())
