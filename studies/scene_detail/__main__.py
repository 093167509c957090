"""`python -m studies.scene_detail`."""

import sys

from studies.scene_detail.run import main

if __name__ == "__main__":
    sys.exit(main())
