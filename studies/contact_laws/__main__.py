"""`python -m studies.contact_laws`."""

from studies.contact_laws.run import main

if __name__ == "__main__":
    raise SystemExit(main())
