"""`python -m studies.which_pin`."""

from studies.which_pin.run import main

if __name__ == "__main__":
    raise SystemExit(main())
