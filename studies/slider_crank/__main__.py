"""`python -m studies.slider_crank`."""

from studies.slider_crank.run import main

if __name__ == "__main__":
    raise SystemExit(main())
