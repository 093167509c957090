"""`python -m studies.slider_crank`."""

import sys

from studies.slider_crank.run import main

if __name__ == "__main__":
    sys.exit(main())
