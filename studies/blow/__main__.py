"""`python -m studies.blow`."""

from studies.blow.run import main

if __name__ == "__main__":
    raise SystemExit(main())
