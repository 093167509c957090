"""`python -m studies.scene_detail`."""

from studies.scene_detail.run import main

if __name__ == "__main__":
    raise SystemExit(main())
