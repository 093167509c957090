"""`python -m studies.valve_modes`."""

from studies.valve_modes.run import main

if __name__ == "__main__":
    raise SystemExit(main())
